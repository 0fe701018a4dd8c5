// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/RegionOfInterest.h"

#include "Common/Error.h"
#include "Freespace/SurfaceResolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Views = std::vector<ViewFeatures>;

namespace
{

class RandomPlaces
{
public:
  explicit RandomPlaces(unsigned int seed)
    : Engine(seed)
  {
  }
  double Uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(this->Engine()) / 4294967296.0;
  }
  Vector3d In(const Vector3d& low, const Vector3d& high)
  {
    const double x = this->Uniform(low.x(), high.x()), y = this->Uniform(low.y(), high.y());
    return { x, y, this->Uniform(low.z(), high.z()) };
  }

private:
  std::mt19937 Engine;
};

// 1500 x 1000 pixels, focal length 1500 pixels; z is up.
ViewFeatures CameraAt(const Vector3d& center, const Vector3d& target)
{
  ViewFeatures view;
  Camera& camera = view.camera;
  camera.K << 1500, 0, 750, 0, 1500, 500, 0, 0, 1;
  camera.width = 1500;
  camera.height = 1000;
  const Vector3d z = (target - center).normalized();
  const Vector3d x = z.cross(Vector3d(0.001, 0.002, 1)).normalized();
  camera.R << x.transpose(), z.cross(x).transpose(), z.transpose();
  camera.t = -camera.R * center;
  return view;
}

using MakePoint = std::function<Vector3d()>;
using SeesIt = std::function<bool(const ViewFeatures&, const Vector3d&)>;

bool HasInImage(const ViewFeatures& view, const Vector3d& point)
{
  return view.camera.Depth(point) > 0 && view.camera.Sees(view.camera.Project(point));
}

// Gives each view so many points that it has in its image.
void AddPoints(Views& views, int count, const MakePoint& make, const SeesIt& sees = HasInImage)
{
  for (ViewFeatures& view : views)
  {
    for (int found = 0, tried = 0; found < count && tried < 200 * count; ++tried)
    {
      const Vector3d point = make();
      if (HasInImage(view, point) && sees(view, point))
      {
        view.points.push_back(point);
        ++found;
      }
    }
  }
}

// Cameras along a wall of 12 x 4, at 8 to 11 from it.
Views Castle(RandomPlaces& random)
{
  Views views;
  for (int i = 0; i < 9; ++i)
  {
    const double x = -6 + 1.5 * i;
    views.push_back(CameraAt({ x, -11 + 0.3 * std::abs(x), 1.6 }, { 0.3 * x, 0, 2 }));
  }
  AddPoints(views, 1000, [&] { return random.In({ -6, -1, 0 }, { 6, 1, 4 }); });
  return views;
}

AlignedBox3d BoundsOf(const Views& views)
{
  AlignedBox3d box;
  for (const ViewFeatures& view : views)
  {
    for (const Vector3d& point : view.points)
    {
      box.extend(point);
    }
  }
  return box;
}

// Moves a share of the features away along their rays, to 10 to 1000 times their depth.
Views Thrown(Views views, double share, RandomPlaces& random)
{
  for (ViewFeatures& view : views)
  {
    for (Vector3d& point : view.points)
    {
      if (random.Uniform(0, 1) < share)
      {
        const double times = std::exp(random.Uniform(std::log(10), std::log(1000)));
        point = view.camera.Center() + times * (point - view.camera.Center());
      }
    }
  }
  return views;
}

RegionOfInterest FindRegionIn(const Views& views, const RegionOptions& options = {})
{
  return FindRegion(views, options);
}

void ExpectAll(const Views& views)
{
  const RegionOfInterest region = FindRegionIn(views);
  EXPECT_EQ(region.beyond, 0u);
  EXPECT_TRUE(region.box.isApprox(BoundsOf(views), 1e-12));
}

// That the region holds a body, and is not much larger.
void ExpectBody(const RegionOfInterest& region, const AlignedBox3d& body)
{
  const double longest = body.sizes().maxCoeff();
  const Vector3d room = Vector3d::Constant(0.3 * longest),
                 slack = Vector3d::Constant(0.01 * longest);
  EXPECT_TRUE(AlignedBox3d(region.box.min() - slack, region.box.max() + slack).contains(body))
    << region.box.min().transpose() << " to " << region.box.max().transpose();
  EXPECT_TRUE(AlignedBox3d(body.min() - room, body.max() + room).contains(region.box))
    << region.box.min().transpose() << " to " << region.box.max().transpose();
}

}

TEST(RegionOfInterest, KeepsACompactBody)
{
  RandomPlaces random(1);
  ExpectAll(Castle(random));
}

TEST(RegionOfInterest, LeavesOutAFarTail)
{
  RandomPlaces random(2);
  Views views = Castle(random);
  const AlignedBox3d body = BoundsOf(views);
  for (ViewFeatures& view : views)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double depth = std::exp(random.Uniform(std::log(48), std::log(440)));
      view.points.push_back(
        view.camera.Unproject({ random.Uniform(0, 1500), random.Uniform(0, 1000) }, depth));
    }
  }
  const RegionOfInterest region = FindRegionIn(views);
  ExpectBody(region, body);
  EXPECT_EQ(region.features, 9 * 1003u);
  EXPECT_EQ(region.beyond, 27u);
}

TEST(RegionOfInterest, FindsAStatueBeforeAFarWall)
{
  for (const double distance : { 3.0, 6.0, 30.0 })
  {
    RandomPlaces random(3);
    Views views;
    for (int i = 0; i < 24; ++i)
    {
      const double angle = i * M_PI / 12;
      views.push_back(
        CameraAt({ 1.5 * std::cos(angle), 1.5 * std::sin(angle), 0.6 }, { 0, 0, 0.5 }));
    }
    // The near side only, as a body hides its back.
    const auto isNear = [](const ViewFeatures& view, const Vector3d& point)
    { return Vector2d(point.head<2>()).dot(Vector2d(view.camera.Center().head<2>())) > 0; };
    AddPoints(
      views, 600,
      [&] {
        return random.In({ -0.25, -0.2, 0 }, { 0.25, 0.2, 1 });
      },
      isNear);
    const AlignedBox3d body = BoundsOf(views);
    AddPoints(views, 600,
      [&]
      {
        const double angle = random.Uniform(0, 2 * M_PI);
        return Vector3d(distance * std::cos(angle), distance * std::sin(angle),
          random.Uniform(-0.4 * distance, 0.6 * distance));
      });
    ExpectBody(FindRegionIn(views), body);
  }
}

TEST(RegionOfInterest, KeepsTheGroundOfAFlight)
{
  RandomPlaces random(4);
  Views views;
  for (int i = 0; i < 48; ++i)
  {
    const double x = -150 + 300.0 / 7 * (i % 8), y = -100 + 200.0 / 5 * (i / 8);
    views.push_back(CameraAt({ x, y, 80 }, { x, y, 0 }));
  }
  AddPoints(views, 200, [&] { return random.In({ -200, -150, 0 }, { 200, 150, 9 }); });
  ExpectAll(views);
}

TEST(RegionOfInterest, KeepsAStreetThatWasDrivenAlong)
{
  RandomPlaces random(5);
  Views views;
  for (int i = 0; i < 18; ++i)
  {
    views.push_back(CameraAt({ -2 + 3.0 * i, 0, 1.5 }, { -1 + 3.0 * i, 0, 1.5 }));
    for (int k = 0; k < 600; ++k)
    {
      // Depths from 5 to the end of the street, as they are seen in perspective.
      const Vector3d ray =
        views.back().camera.Ray({ random.Uniform(0, 1500), random.Uniform(0, 1000) });
      const double wall = 4 / std::max(std::abs(ray.y()), 1e-9);
      const double ground = (ray.z() < 0 ? 1.5 : 6) / std::max(std::abs(ray.z()), 1e-9);
      const double end = 60 + 2 - 3.0 * i;
      const double depth = std::min({ wall, ground, end });
      views.back().points.push_back(views.back().camera.Center() + depth * ray);
    }
  }
  ExpectAll(views);
}

TEST(RegionOfInterest, KeepsARowOfHousesAndTwoTowers)
{
  RandomPlaces random(6);
  Views row, towers;
  for (int i = 0; i < 30; ++i)
  {
    const double x = -35 + 70.0 / 29 * i;
    row.push_back(CameraAt({ x, -12, 2 }, { x, 0, 4 }));
  }
  AddPoints(row, 300, [&] { return random.In({ -40, 0, 0 }, { 40, 1, 10 }); });
  ExpectAll(row);
  for (int i = 0; i < 24; ++i)
  {
    const double x = i < 12 ? 0 : 60, angle = i * M_PI / 6;
    towers.push_back(CameraAt({ x + 18 * std::cos(angle), 18 * std::sin(angle), 6 }, { x, 0, 5 }));
  }
  AddPoints(towers, 300, [&] { return random.In({ -5, -5, 0 }, { 5, 5, 10 }); });
  AddPoints(towers, 300, [&] { return random.In({ 55, -5, 0 }, { 65, 5, 10 }); });
  ExpectAll(towers);
}

TEST(RegionOfInterest, KeepsAllOfAWallThatWasMostlyTakenFromNear)
{
  RandomPlaces random(7);
  Views views = Castle(random);
  for (int i = 0; i < 12; ++i)
  {
    views.push_back(CameraAt({ 0.2 * i, -2.2, 1.6 }, { 0.2 * i, 0, 1.6 }));
    views.back().points.clear();
  }
  Views close(views.begin() + 9, views.end());
  AddPoints(close, 1000, [&] { return random.In({ -6, -0.2, 0 }, { 6, 0.2, 4 }); });
  std::copy(close.begin(), close.end(), views.begin() + 9);
  ExpectAll(views);
}

TEST(RegionOfInterest, IsNotMovedByFeaturesThatWereThrownAway)
{
  RandomPlaces random(8);
  const Views views = Castle(random);
  const RegionOfInterest region = FindRegionIn(Thrown(views, 0.002, random));
  ExpectBody(region, BoundsOf(views));
  EXPECT_GT(region.beyond, 0u);
}

TEST(RegionOfInterest, IsTheSameInAnyUnitAndPlaceOfTheWorld)
{
  RandomPlaces random(9);
  const Views views = Thrown(Castle(random), 0.01, random);
  const AlignedBox3d box = FindRegionIn(views).box;
  const double scale = 1000;
  const Vector3d offset(4e5, -5e6, 100);
  Views moved = views;
  for (ViewFeatures& view : moved)
  {
    view.camera.t = scale * view.camera.t - view.camera.R * offset;
    for (Vector3d& point : view.points)
    {
      point = scale * point + offset;
    }
  }
  const AlignedBox3d there = FindRegionIn(moved).box;
  EXPECT_LT((there.min() - (scale * box.min() + offset)).norm(), 1e-3);
  EXPECT_LT((there.max() - (scale * box.max() + offset)).norm(), 1e-3);
}

TEST(RegionOfInterest, IsTheSameInAnyOrderOfWork)
{
  RandomPlaces random(10);
  const Views views = Thrown(Castle(random), 0.01, random);
  const auto backwards =
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    for (std::size_t i = count; i-- > 0;)
    {
      body(i, i + 1);
    }
  };
  const RegionOfInterest there = FindRegion(views, {}, backwards), here = FindRegionIn(views);
  EXPECT_EQ(here.box.min(), there.box.min());
  EXPECT_EQ(here.box.max(), there.box.max());
  EXPECT_EQ(here.beyond, there.beyond);
}

TEST(RegionOfInterest, HoldsAllWhereThatIsAsked)
{
  RandomPlaces random(11);
  const Views views = Thrown(Castle(random), 0.01, random);
  RegionOptions options;
  options.mode = RegionOptions::Mode::All;
  EXPECT_EQ(FindRegionIn(views, options).beyond, 0u);
  EXPECT_TRUE(FindRegionIn(views, options).box.isApprox(BoundsOf(views)));
}

TEST(RegionOfInterest, HoldsTheFeaturesInAGivenBox)
{
  RandomPlaces random(12);
  const Views views = Castle(random);
  RegionOptions options;
  options.mode = RegionOptions::Mode::Box;
  options.box = AlignedBox3d(Vector3d(0, -100, 1), Vector3d(2, 100, 3));
  const RegionOfInterest region = FindRegionIn(views, options);
  std::size_t inside = 0;
  for (const ViewFeatures& view : views)
  {
    for (const Vector3d& point : view.points)
    {
      inside += options.box.contains(point);
    }
  }
  EXPECT_EQ(region.features - region.beyond, inside);
  EXPECT_TRUE(options.box.contains(region.box));
  EXPECT_NEAR(region.box.sizes().x(), 2, 0.1);
  options.box.translate(Vector3d(1000, 0, 0));
  EXPECT_THROW(FindRegionIn(views, options), Error);
  options.box = AlignedBox3d(Vector3d(2, 0, 0), Vector3d(1, 1, 1));
  EXPECT_THROW(FindRegionIn(views, options), Error);
}

TEST(RegionOfInterest, TakesWhatIsTooLittleOrFlat)
{
  EXPECT_TRUE(FindRegionIn({}).box.isEmpty());
  Views views(3, CameraAt({ 0, -5, 0 }, { 0, 0, 0 }));
  EXPECT_TRUE(FindRegionIn(views).box.isEmpty());
  views[0].points.assign(500, Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(FindRegionIn(views).box.diagonal(), Vector3d::Zero());
  EXPECT_EQ(FindRegionIn(views).beyond, 0u);
  for (int i = 0; i < 500; ++i)
  {
    views[1].points.push_back({ 0.001 * i, 0.2, 0.3 });
  }
  EXPECT_EQ(FindRegionIn(views).beyond, 0u);
  views[1].points.assign(20, Vector3d(0, 1e6, 0));
  views[0].points.resize(60);
  EXPECT_EQ(FindRegionIn(views).beyond, 0u) << "of so few none is an exception";
}

TEST(RegionOfInterest, ChecksItsOptions)
{
  RegionOptions options;
  options.lossForSize = 0;
  EXPECT_THROW(options.Check(), Error);
  options = {};
  options.leastGain = 0.5;
  EXPECT_THROW(options.Check(), Error);
  options = {};
  options.surroundings = NAN;
  EXPECT_THROW(options.Check(), Error);
}
