// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SimplifySurface.h"

#include "Contour/BisectionContour.h"
#include "Freespace/FreespaceUnion.h"
#include "Mesh/TriangleIntersections.h"
#include "Support/MeshTopology.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

class Slab : public ContourField
{
public:
  bool IsFree(const Vector3d& p, const FieldScope&) const override
  {
    return (p.cwiseAbs() - Vector3d(0.8, 0.6, 0.2)).maxCoeff() > 0;
  }
};

ContourMesh ContourOf(const ContourField& field, double half, int cells)
{
  ContourOptions options;
  options.cells = cells;
  options.sharp = false;
  return BisectionContour(field, { Vector3d::Constant(-half), Vector3d::Constant(half) }, options);
}

LabelledSurface SurfaceOf(const ContourMesh& mesh)
{
  LabelledSurface surface;
  std::vector<Eigen::Vector3f> rounded; // in single precision the contour meets itself nowhere
  for (const Vector3d& p : mesh.points)
  {
    rounded.push_back(p.cast<float>());
  }
  for (const Eigen::Vector3f& p : rounded)
  {
    surface.points.push_back(p.cast<double>());
  }
  surface.triangles = mesh.triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    surface.labels.push_back(4 * mesh.view[t] + static_cast<int>(mesh.kind[t]));
  }
  return surface;
}

ContourMesh MeshOf(const LabelledSurface& surface)
{
  ContourMesh mesh;
  mesh.points = surface.points;
  mesh.triangles = surface.triangles;
  return mesh;
}

double SquaredDistance(const Vector3d& p, const std::array<Vector3d, 3>& t)
{
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  bool isInside = true;
  double least = HUGE_VAL;
  for (int i = 0; i < 3; ++i)
  {
    const Vector3d &a = t[i], &b = t[(i + 1) % 3];
    isInside = isInside && (b - a).cross(p - a).dot(normal) >= 0;
    const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + s * (b - a) - p).squaredNorm());
  }
  const double height = normal.dot(p - t[0]);
  return isInside ? height * height : least;
}

// From places all over one surface (corners, sides, inside of triangles) to the other, by brute force.
double FurthestSample(const LabelledSurface& from, const LabelledSurface& to)
{
  const std::size_t step = 1 + from.triangles.size() / 400;
  double furthest = 0.0;
  for (std::size_t t = 0; t < from.triangles.size(); t += step)
  {
    for (const Vector3d& weight : { Vector3d(1, 0, 0), Vector3d(0.5, 0.5, 0),
           Vector3d(1 / 3., 1 / 3., 1 / 3.), Vector3d(0.1, 0.2, 0.7) })
    {
      Vector3d p = Vector3d::Zero();
      for (int i = 0; i < 3; ++i)
      {
        p += weight[i] * from.points[from.triangles[t][i]];
      }
      double least = HUGE_VAL;
      for (const auto& other : to.triangles)
      {
        least = std::min(least,
          SquaredDistance(p, { to.points[other[0]], to.points[other[1]], to.points[other[2]] }));
      }
      furthest = std::max(furthest, std::sqrt(least));
    }
  }
  return furthest;
}

bool LabelledMeetsItself(const LabelledSurface& surface)
{
  const TriangleSoup soup = { [&](std::int32_t v) { return surface.points[v]; },
    surface.triangles[0].data(), surface.triangles.size() };
  std::vector<std::size_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return !FindIntersections(soup, all, 0.1, [](std::size_t, std::size_t) { return true; }).empty();
}

SimplifyOptions Bound(double bound)
{
  SimplifyOptions options;
  options.bound = bound;
  options.isSingle = true;
  return options;
}

}

TEST(SimplifySurface, FlatRegionsLoseTheirVertices)
{
  const LabelledSurface slab = SurfaceOf(ContourOf(Slab(), 1.0, 40));
  const LabelledSurface simple = SimplifySurface(slab, Bound(1e-3));
  EXPECT_LT(simple.triangles.size(), slab.triangles.size() / 10);
  EXPECT_EQ(TopologyFaults(MeshOf(simple)), "");
  EXPECT_NEAR(EnclosedVolume(MeshOf(simple)), EnclosedVolume(MeshOf(slab)), 5e-3);
  EXPECT_LE(FurthestSample(slab, simple), 1e-3);
  EXPECT_LE(FurthestSample(simple, slab), 1e-3);
}

TEST(SimplifySurface, RandomUnionsKeepTheBoundTheTopologyAndTheLabels)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    const FreespaceUnion phi(RandomMaps(50 + seed, 1 + seed % 4), {});
    ContourOptions contour;
    contour.cells = 30;
    contour.sharp = seed % 2 == 1;
    const LabelledSurface surface = SurfaceOf(BisectionContour(phi, phi.Hull().Bounds(), contour));
    const double bound = (seed % 3 == 0 ? 0.1 : 0.5) * phi.Hull().Bounds().sizes().maxCoeff() / 29;
    const LabelledSurface simple = SimplifySurface(surface, Bound(bound));
    EXPECT_LT(simple.triangles.size(), surface.triangles.size() * 9 / 10) << seed;
    EXPECT_EQ(TopologyFaults(MeshOf(simple)), "");
    EXPECT_FALSE(LabelledMeetsItself(simple));
    EXPECT_LE(FurthestSample(surface, simple), bound);
    EXPECT_LE(FurthestSample(simple, surface), bound);
    // Each label's border stays, so its region shows the same area, but for what the bound allows.
    std::map<std::int64_t, Vector3d> before, after;
    const std::pair<decltype(&surface), decltype(&before)> sides[] = { { &surface, &before },
      { &simple, &after } };
    for (const auto& [from, areas] : sides)
    {
      for (std::size_t t = 0; t < from->triangles.size(); ++t)
      {
        const auto& c = from->triangles[t];
        const Vector3d a = from->points[c[0]];
        auto& sum = areas->emplace(from->labels[t], Vector3d::Zero()).first->second;
        sum += 0.5 * (from->points[c[1]] - a).cross(from->points[c[2]] - a);
      }
    }
    ASSERT_EQ(before.size(), after.size());
    for (const auto& [label, area] : before)
    {
      // The vector area depends on the border alone.
      EXPECT_LT((after[label] - area).norm(), 1e-9) << label;
    }
  }
}

TEST(SimplifySurface, IsTheSameTwice)
{
  const LabelledSurface slab = SurfaceOf(ContourOf(Slab(), 1.0, 20));
  const LabelledSurface a = SimplifySurface(slab, Bound(0.01)),
                        b = SimplifySurface(slab, Bound(0.01));
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(SimplifySurface, KeepsBorders)
{
  // A flat square with a border of 40 sides.
  LabelledSurface square;
  for (int j = 0; j <= 10; ++j)
  {
    for (int i = 0; i <= 10; ++i)
    {
      square.points.emplace_back(i, j, 0);
      if (i < 10 && j < 10)
      {
        const int a = 11 * j + i;
        square.triangles.push_back({ a, a + 1, a + 12 });
        square.triangles.push_back({ a, a + 12, a + 11 });
      }
    }
  }
  const LabelledSurface simple = SimplifySurface(square, Bound(0.01));
  EXPECT_LE(simple.points.size(), 45u);
  int border = 0;
  for (const Vector3d& p : simple.points)
  {
    border += p.x() == 0 || p.y() == 0 || p.x() == 10 || p.y() == 10;
  }
  EXPECT_EQ(border, 40);
}

TEST(SimplifySurface, AwkwardInput)
{
  EXPECT_TRUE(SimplifySurface({}, Bound(1)).triangles.empty());
  EXPECT_THROW(SimplifySurface({}, Bound(0)), Error);
  EXPECT_THROW(SimplifySurface({}, Bound(NAN)), Error);
  LabelledSurface surface;
  surface.points = { Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1) };
  surface.triangles = { { 0, 1, 2 } };
  EXPECT_EQ(SimplifySurface(surface, Bound(1)).triangles, surface.triangles);
  surface.triangles = { { 0, 1, 2 }, { 0, 1, 3 } }; // turned against each other
  EXPECT_THROW(SimplifySurface(surface, Bound(1)), Error);
  surface.points[0].x() = NAN;
  EXPECT_THROW(SimplifySurface(surface, Bound(1)), Error);
}

TEST(SimplifySurface, StopsOnRequest)
{
  const LabelledSurface slab = SurfaceOf(ContourOf(Slab(), 1.0, 40));
  const Progress stop([](double fraction) { return fraction < 0.3; });
  EXPECT_THROW(SimplifySurface(slab, Bound(1e-3), stop), Aborted);
}
