// SPDX-License-Identifier: BSD-3-Clause
#include "ViewSelection/ViewSelection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A square of side 2 around the origin, at z = 0, and cameras in a row that look at it straight along z.
TriangleMesh SquareMesh()
{
  return { { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } },
    { { 0, 2, 1 }, { 0, 3, 2 } } };
}

Photograph ViewFrom(double x, double distance = 4)
{
  Photograph view;
  view.camera.width = view.camera.height = 80;
  view.camera.K << 60, 0, 40, 0, 60, 40, 0, 0, 1;
  view.camera.t = -Vector3d(x, 0, -distance);
  return view;
}

struct CameraRow
{
  std::vector<Photograph> views;
  std::vector<VisibilityMap> maps;
  std::vector<Vector3d> samples;

  explicit CameraRow(const std::vector<double>& places, const TriangleMesh& mesh = SquareMesh())
  {
    for (const double x : places)
    {
      views.push_back(ViewFrom(x));
      maps.push_back(MakeVisibilityMap(mesh, views.back().camera));
    }
    for (int i = -4; i <= 4; ++i)
    {
      samples.emplace_back(0.2 * i, 0.1 * i, 0);
    }
  }

  std::vector<int> Best(double x, std::size_t count) const
  {
    return BestViews(this->views, this->maps, this->samples, { x, 0, -4 }, count);
  }
};

}

TEST(ViewSelection, TheNearestViewsAreTheBest)
{
  const CameraRow row({ -1.5, -0.9, -0.3, 0.3, 0.9, 1.5 });
  EXPECT_EQ(row.Best(-0.9, 1), (std::vector<int>{ 1 }));
  EXPECT_EQ(row.Best(0, 2), (std::vector<int>{ 2, 3 }));
  EXPECT_EQ(row.Best(1.4, 3), (std::vector<int>{ 3, 4, 5 }));
}

TEST(ViewSelection, FewViewsAreAllTaken)
{
  const CameraRow row({ -0.3, 0.3 });
  EXPECT_EQ(row.Best(9, 2), (std::vector<int>{ 0, 1 }));
  EXPECT_EQ(row.Best(9, 5), (std::vector<int>{ 0, 1 }));
}

// A view that does not see the surface is worth nothing, however near it is.
TEST(ViewSelection, AViewFromWhichNothingIsSeenIsNotTaken)
{
  CameraRow row({ -0.9, 0, 0.9 });
  row.views[1].camera.t = -Vector3d(0, 0, 4); // it looks away
  row.maps[1] = MakeVisibilityMap(SquareMesh(), row.views[1].camera);
  EXPECT_EQ(row.Best(0, 2), (std::vector<int>{ 0, 2 }));
}

TEST(ViewSelection, OrderIsThatOfTheLeastChord)
{
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const auto somewhere = [&](double scale)
  { return Vector3d(scale * Vector3d(normal(random), normal(random), normal(random))); };
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<Vector3d> centers, samples;
    for (int i = 0; i < 12; ++i)
    {
      centers.push_back(somewhere(4));
      samples.push_back(somewhere(0.5));
    }
    const Vector3d novel = somewhere(4);
    const ViewOrder order = OrderViews(centers, samples, novel);
    ASSERT_EQ(order.views.size(), centers.size());
    ASSERT_EQ(order.chords.size(), centers.size());
    EXPECT_EQ(std::set<int>(order.views.begin(), order.views.end()).size(), centers.size());
    EXPECT_TRUE(std::is_sorted(order.chords.begin(), order.chords.end()));
    for (std::size_t i = 0; i < order.views.size(); ++i)
    {
      double least = 2;
      for (const Vector3d& sample : samples)
      {
        // The chord of an angle.
        const Vector3d a = centers[order.views[i]] - sample, b = novel - sample;
        least = std::min(least, 2 * std::sin(0.5 * std::atan2(a.cross(b).norm(), a.dot(b))));
      }
      EXPECT_LE(order.chords[i], least) << "a bound for every sample";
      EXPECT_GE(order.chords[i], least - 0.05) << "that says something";
    }
  }
}

TEST(ViewSelection, WithoutSamplesAllAreAsFar)
{
  const ViewOrder order = OrderViews({ { 1, 0, 0 }, { 0, 1, 0 } }, {}, { 0, 0, 1 });
  EXPECT_EQ(order.views, (std::vector<int>{ 0, 1 }));
  EXPECT_EQ(order.chords[0], order.chords[1]);
}
