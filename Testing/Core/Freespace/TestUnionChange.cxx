// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/Changes/UnionChange.h"

#include "Contour/BisectionContour.h"
#include "Support/PlainSettings.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// Maps around a scene; some from within it, whose cameras' surroundings are free, and some silhouettes.
SharedMaps PoolOfMaps(std::mt19937& random, int count)
{
  SharedMaps pool;
  for (int i = 0; i < count; ++i)
  {
    DisparityMap map = RandomMap(random, i);
    if (i % 4 == 1)
    {
      map.camera = LookingAt(0.2 * Vector3d::Random(), Vector3d::Random());
      for (std::size_t p = 0; p < map.points.size(); ++p)
      {
        map.points[p] = map.camera.Unproject(map.imagePoints[p], 0.4 + random() % 10 * 0.05);
      }
    }
    if (i % 7 == 6)
    {
      map.sourceView.assign(map.points.size(), -1);
    }
    pool.push_back(std::make_shared<const MapFreespace>(map, static_cast<std::size_t>(i)));
  }
  return pool;
}

class ArrayContour
{
public:
  AllocateContour Allocate()
  {
    return [this](const ContourSize& size)
    {
      this->Mesh.points.resize(size.points);
      this->Mesh.triangles.resize(size.triangles);
      this->Mesh.view.resize(size.triangles);
      this->Mesh.kind.resize(size.triangles);
      ContourArrays arrays;
      arrays.doublePoints = size.points ? this->Mesh.points[0].data() : nullptr;
      arrays.triangles = size.triangles ? this->Mesh.triangles[0].data() : nullptr;
      arrays.view = this->Mesh.view.data();
      arrays.kind = this->Mesh.kind.data();
      return arrays;
    };
  }
  ContourMesh Mesh;
};

void ExpectSameMesh(const ContourMesh& a, const ContourMesh& b)
{
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
  {
    ASSERT_EQ(a.points[i], b.points[i]) << i;
  }
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.view, b.view);
  EXPECT_EQ(a.kind, b.kind);
}

// The lattice of a scene, which views do not change.
const Eigen::AlignedBox3d Room(Vector3d(-1.1, -1.2, -1.0), Vector3d(1.2, 1.0, 1.1));

// Goes from one random selection of the pool to the next, and compares each contour with a fresh one.
void WalkThrough(unsigned int seed, const FreespaceUnionOptions& options, bool isFixed,
  const ContourOptions& contour)
{
  std::mt19937 random(seed);
  std::srand(seed);
  const SharedMaps pool = PoolOfMaps(random, 9);
  std::vector<char> isIn(pool.size(), 1);
  std::shared_ptr<const FreespaceUnion> before;
  KeptContour kept;
  for (int step = 0; step < 7; ++step)
  {
    SharedMaps maps;
    for (std::size_t i = 0; i < pool.size(); ++i)
    {
      if (isIn[i] || i < 2)
      {
        maps.push_back(pool[i]);
      }
    }
    const auto now = std::make_shared<const FreespaceUnion>(maps, options, SerialFor, Progress());
    const Eigen::AlignedBox3d bounds = isFixed ? Room : now->Hull().Bounds();
    ArrayContour incremental, fresh;
    std::unique_ptr<UnionChange> change;
    if (before)
    {
      change = std::make_unique<UnionChange>(before, now);
    }
    BisectionContour(*now, bounds, contour, incremental.Allocate(), kept, change.get());
    BisectionContour(*now, bounds, contour, fresh.Allocate());
    ExpectSameMesh(incremental.Mesh, fresh.Mesh);
    ASSERT_FALSE(fresh.Mesh.triangles.empty());
    before = now;
    isIn[random() % isIn.size()] ^= 1;
  }
}

}

TEST(UnionChange, ContoursAreThoseFromNothing)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    FreespaceUnionOptions options;
    options.minimumViews = seed % 3 == 2 ? 2 : seed % 3 == 1 ? 1 : -1;
    options.hullMargin = 0.02;
    options.region.mode = seed % 2 ? RegionOptions::Mode::All : RegionOptions::Mode::Automatic;
    ContourOptions contour;
    contour.cells = 40 + static_cast<int>(seed % 5) * 9;
    contour.sharp = seed % 4 < 2;
    contour.exact = seed % 5 != 4;
    SCOPED_TRACE(seed);
    WalkThrough(seed, options, seed % 5 != 3, contour);
  }
}

TEST(UnionChange, ViewsThatSeeElsewhereLeaveTheSurface)
{
  std::mt19937 random(3);
  std::srand(3);
  SharedMaps maps = PoolOfMaps(random, 4);
  FreespaceUnionOptions options;
  options.hullMargin = 0.02;
  options.region.mode = RegionOptions::Mode::Box;
  options.region.box = Room;
  const auto before = std::make_shared<const FreespaceUnion>(maps, options, SerialFor, Progress());
  DisparityMap away = RandomMap(random, 4);
  away.camera = LookingAt(Vector3d(5, 0, 0), Vector3d(9, 0, 0));
  for (std::size_t p = 0; p < away.points.size(); ++p)
  {
    away.points[p] = away.camera.Unproject(away.imagePoints[p], 3.0);
  }
  maps.push_back(std::make_shared<const MapFreespace>(away, 4u));
  const auto now = std::make_shared<const FreespaceUnion>(maps, options, SerialFor, Progress());
  const UnionChange change(before, now);
  ChangeScope scope;
  EXPECT_TRUE(change.Leaves(Room, change.Root(), scope));
  EXPECT_FALSE(
    change.Leaves({ Vector3d(6, -0.1, -0.1), Vector3d(7, 0.1, 0.1) }, change.Root(), scope));
  EXPECT_EQ(change.ViewNow(3), 3);
  EXPECT_EQ(change.ViewNow(-1), -1);
  // Another rule of the votes changes everything.
  options.minimumViews = 1;
  const auto other = std::make_shared<const FreespaceUnion>(maps, options, SerialFor, Progress());
  EXPECT_TRUE(UnionChange(now, other).Root().isEverything);
}
