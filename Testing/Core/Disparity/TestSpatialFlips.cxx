// SPDX-License-Identifier: BSD-3-Clause
// Edges of a disparity map's triangulation that are flipped for their triangles' shape in space.
#include "Disparity/DelaunayDisparity.h"

#include "Common/Error.h"
#include "Support/FeatureViews.h"
#include "Support/Core/MapEdges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// The corners of a rhombus on a steep plane, twice as long in depth as wide. In the image the plane is foreshortened, and
// the diagonal in depth, between the last two, is the shorter one.
std::vector<View> SteepRhombus()
{
  std::vector<View> views(1, MakeView());
  const Vector3d center(0, 0, 5), across(0.3, 0, 0), along(0, 0.12, 0.588);
  AddFeature(views[0], center - across);
  AddFeature(views[0], center + across);
  AddFeature(views[0], center - along);
  AddFeature(views[0], center + along);
  return views;
}

double TwiceArea(const DisparityMap& map, const std::array<int, 3>& t)
{
  return Cross(
    map.imagePoints[t[1]] - map.imagePoints[t[0]], map.imagePoints[t[2]] - map.imagePoints[t[0]]);
}

double Cotangent(const Vector3d& apex, const Vector3d& a, const Vector3d& b)
{
  return (a - apex).dot(b - apex) / (a - apex).cross(b - apex).norm();
}

// The triangles of each edge, by their corners opposite it.
std::map<std::pair<int, int>, std::vector<int>> ApexesOfEdges(const DisparityMap& map)
{
  std::map<std::pair<int, int>, std::vector<int>> apexes;
  for (const std::array<int, 3>& t : map.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      apexes[std::minmax(t[(i + 1) % 3], t[(i + 2) % 3])].push_back(t[i]);
    }
  }
  return apexes;
}

bool IsStrictlyConvex(const DisparityMap& map, int a, int c, int b, int d)
{
  const auto side = [&map](int i, int j, int k) {
    return Cross(map.imagePoints[j] - map.imagePoints[i], map.imagePoints[k] - map.imagePoints[i]);
  };
  constexpr double little = 1e-6;
  return (side(c, a, d) > little && side(c, b, d) < -little) ||
    (side(c, a, d) < -little && side(c, b, d) > little);
}

}

TEST(SpatialFlips, TheShorterDiagonalInSpaceWins)
{
  const std::vector<View> views = SteepRhombus();
  DelaunayDisparityOptions options;
  options.spatialFlips = false;
  const DisparityMap image = TriangulateView(views, 0, options);
  ASSERT_TRUE(HasEdge(image, 2, 3)) << "Delaunay's in the image";
  options.spatialFlips = true;
  const DisparityMap space = TriangulateView(views, 0, options);
  EXPECT_TRUE(HasEdge(space, 0, 1));
  EXPECT_FALSE(HasEdge(space, 2, 3));
  EXPECT_EQ(space.triangles.size(), 2u);
}

TEST(SpatialFlips, EdgesOfTheStereoStay)
{
  std::vector<View> views = SteepRhombus();
  views[0].edges = { { 3, 2 } };
  for (const bool keepEdges : { false, true })
  {
    DelaunayDisparityOptions options;
    options.keepEdges = keepEdges;
    EXPECT_TRUE(HasEdge(TriangulateView(views, 0, options), 2, 3));
  }
}

// A plane that faces the camera is as it is in the image.
TEST(SpatialFlips, DelaunayStaysOnAPlaneBeforeTheCamera)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    std::vector<View> views = RandomViews(seed);
    View flat = MakeView();
    for (const Vector2d& pixel : views[0].imagePoints)
    {
      AddFeature(flat, pixel, 2);
    }
    DelaunayDisparityOptions options;
    const DisparityMap flipped = TriangulateView({ flat }, 0, options);
    options.spatialFlips = false;
    EXPECT_EQ(flipped.triangles, TriangulateView({ flat }, 0, options).triangles);
  }
}

// How much greater the disparity along c-d is than that along a-b where they cross in the image, as a share.
double Rise(const DisparityMap& map, int a, int b, int c, int d)
{
  const Eigen::Vector2d origin = map.imagePoints[a];
  Eigen::Matrix2d axes;
  axes.col(0) = map.imagePoints[b] - origin;
  axes.col(1) = map.imagePoints[c] - map.imagePoints[d];
  const Eigen::Vector2d shares = axes.inverse() * (map.imagePoints[c] - origin);
  const auto disparity = [&map](int from, int to, double share)
  {
    const double first = 1 / map.camera.Depth(map.points[from]);
    return first + share * (1 / map.camera.Depth(map.points[to]) - first);
  };
  return disparity(c, d, shares[1]) / disparity(a, b, shares[0]) - 1;
}

// The triangles still cover the hull of the features without overlap, and no edge is left that would be flipped:
// one whose other diagonal is better, and not before it by more than a thousandth.
TEST(SpatialFlips, NoEdgeIsLeftToFlip)
{
  for (unsigned int seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<View> views = { RandomViews(seed)[0] };
    DelaunayDisparityOptions options;
    options.minimumDisparity = false;
    const DisparityMap map = TriangulateView(views, 0, options);
    options.spatialFlips = false;
    const DisparityMap image = TriangulateView(views, 0, options);
    double area = 0, expected = 0;
    for (const auto& triangle : map.triangles)
    {
      EXPECT_GT(TwiceArea(map, triangle), 0);
      area += TwiceArea(map, triangle);
    }
    for (const auto& triangle : image.triangles)
    {
      expected += TwiceArea(image, triangle);
    }
    EXPECT_NEAR(area, expected, 1e-9 * expected);
    for (const auto& [edge, apexes] : ApexesOfEdges(map))
    {
      if (apexes.size() < 2)
      {
        continue;
      }
      const Vector3d &a = map.points[edge.first], &b = map.points[edge.second],
                     &c = map.points[apexes[0]], &d = map.points[apexes[1]];
      const double sum = Cotangent(c, a, b) + Cotangent(d, a, b);
      const double other = Cotangent(a, c, d) + Cotangent(b, c, d);
      EXPECT_FALSE(sum < options.leastCotangents - 1e-9 && other > sum + 1e-9 &&
        IsStrictlyConvex(map, edge.first, apexes[0], edge.second, apexes[1]) &&
        Rise(map, edge.first, edge.second, apexes[0], apexes[1]) < 1e-3 - 1e-9)
        << edge.first << " " << edge.second;
    }
  }
}

// A flip may put the surface behind a feature of another view: the constraint holds afterwards.
TEST(SpatialFlips, NothingSticksOutAfterwards)
{
  int flipped = 0;
  for (unsigned int seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<View> views = seed % 2 ? LatticeViews(seed) : RandomViews(seed);
    DelaunayDisparityOptions options;
    options.tolerance = 1e-6;
    options.keepEdges = seed % 4 < 2;
    const DisparityMap map = TriangulateView(views, 0, options);
    options.spatialFlips = false;
    flipped += map.triangles != TriangulateView(views, 0, options).triangles;
    for (const View& view : views)
    {
      for (const Vector3d& point : view.points)
      {
        if (const auto disparity = DisparityAt(map, map.camera.Project(point)))
        {
          EXPECT_LE(1 / map.camera.Depth(point), *disparity * (1 + 1e-5));
        }
      }
    }
  }
  EXPECT_GT(flipped, 50) << "there was something to flip";
}

TEST(SpatialFlips, PositiveThresholdIsAnError)
{
  for (const double threshold : { 0.1, std::nan("") })
  {
    DelaunayDisparityOptions options;
    options.leastCotangents = threshold;
    EXPECT_THROW(TriangulateView(SteepRhombus(), 0, options), Error);
  }
}
