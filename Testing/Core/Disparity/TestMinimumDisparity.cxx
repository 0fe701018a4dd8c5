// SPDX-License-Identifier: BSD-3-Clause
// The minimum disparity constraint on the paper's figures 4 and 5.
#include "Disparity/DelaunayDisparity.h"

#include "Support/FeatureViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace freespace;

namespace
{

// Figure 4: a folded sheet. Cluster 1 misses its ridge P; cluster 2 has P; cluster 3 sees the sheet
// from behind and recovers Q there, which is hidden from cluster 1.
struct FoldedSheet
{
  std::vector<View> views = std::vector<View>(3, MakeView());

  FoldedSheet()
  {
    for (double y = -1.5; y <= 1.5; y += 0.125)
    {
      AddFeature(this->views[0], Eigen::Vector3d(-1.5, y, 5));
      AddFeature(this->views[0], Eigen::Vector3d(1.5, y, 5));
    }
    for (double y = -1; y <= 1; y += 0.0625)
    {
      AddFeature(this->views[1], Eigen::Vector3d(0.25, y, 4));
      AddFeature(this->views[2], Eigen::Vector3d(0.25, y, 4.7));
    }
  }

  // How much of the front half of the sheet a map takes for free space.
  double Carved(const DisparityMap& map) const
  {
    int carved = 0, count = 0;
    for (double y = -0.5; y <= 0.5; y += 0.05)
    {
      for (double s = 0.05; s < 1; s += 0.1)
      {
        const double x = 0.25 + s * 1.25, z = 4 + s;
        carved += IsFree(map, { x, y, z + 0.01 }) + IsFree(map, { 0.5 - x, y, z + 0.15 });
        count += 2;
      }
    }
    return static_cast<double>(carved) / count;
  }
};

}

TEST(DelaunayDisparity, Figure4MissedFeatureIsSupplied)
{
  const FoldedSheet sheet;
  DelaunayDisparityOptions options;
  options.minimumDisparity = false;
  const DisparityMap missed = TriangulateView(sheet.views, 0, options);
  EXPECT_GT(sheet.Carved(missed), 0.8) << "the figure needs a view that misses the ridge";

  options.minimumDisparity = true;
  const DisparityMap greedy = TriangulateView(sheet.views, 0, options);
  EXPECT_EQ(sheet.Carved(greedy), 0);
  EXPECT_GT(std::count(greedy.sourceView.begin(), greedy.sourceView.end(), 1), 0);
  EXPECT_EQ(std::count(greedy.sourceView.begin(), greedy.sourceView.end(), 2), 0);
}

TEST(DelaunayDisparity, Figure4AddingAllThatViolateIsTooLiberal)
{
  FoldedSheet sheet;
  DelaunayDisparityOptions options;
  options.minimumDisparity = false;
  const DisparityMap missed = TriangulateView(sheet.views, 0, options);
  int hidden = 0;
  for (int v = 1; v <= 2; ++v)
  {
    for (const Eigen::Vector3d& point : sheet.views[v].points)
    {
      if (IsFree(missed, point))
      {
        AddFeature(sheet.views[0], point);
        hidden += v == 2;
      }
    }
  }
  ASSERT_GT(hidden, 0);
  EXPECT_GT(sheet.Carved(TriangulateView(sheet.views, 0, options)), 0.2);
}

// Figure 5: each cluster recovers two occluding contours of a cylinder without features.
TEST(DelaunayDisparity, Figure5FeaturelessCylinder)
{
  constexpr int clusters = 8;
  const double pi = std::acos(-1.0), distance = 6, tangent = std::acos(1 / distance);
  std::vector<View> views(clusters, MakeView());
  std::vector<double> contour; // angles on the cylinder
  for (int v = 0; v < clusters; ++v)
  {
    const double angle = 2 * pi * v / clusters;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    Camera& camera = views[v].camera;
    camera.R << up.cross(out).transpose(), -up.transpose(), -out.transpose();
    camera.t = -camera.R * (distance * out);
    for (const double side : { -tangent, tangent })
    {
      contour.push_back(angle + side);
      for (double z = -2; z <= 2; z += 0.1)
      {
        AddFeature(views[v], Eigen::Vector3d(std::cos(angle + side), std::sin(angle + side), z));
      }
    }
  }
  std::sort(contour.begin(), contour.end(),
    [pi](double a, double b) { return std::remainder(a, 2 * pi) < std::remainder(b, 2 * pi); });

  DelaunayDisparityOptions options;
  options.tolerance = 1e-9;
  const std::vector<DisparityMap> constrained = TriangulateViews(views, options);
  options.minimumDisparity = false;
  const std::vector<DisparityMap> unconstrained = TriangulateViews(views, options);
  const auto freeInAny = [](const std::vector<DisparityMap>& maps, const Eigen::Vector3d& point)
  {
    return std::any_of(
      maps.begin(), maps.end(), [&point](const DisparityMap& map) { return IsFree(map, point); });
  };
  int carved = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) // the sides of the recovered polygon
  {
    const double a = contour[i], b = contour[(i + 1) % contour.size()];
    const Eigen::Vector3d begin(std::cos(a), std::sin(a), 0), end(std::cos(b), std::sin(b), 0);
    for (double s = 0.05; s < 1; s += 0.1)
    {
      const Eigen::Vector3d side = begin + s * (end - begin) + Eigen::Vector3d(0, 0, 0.03);
      EXPECT_FALSE(freeInAny(constrained, 0.99 * side)) << "side " << i << " at " << s;
      EXPECT_TRUE(freeInAny(constrained, 1.01 * side)) << "side " << i << " at " << s;
      carved += freeInAny(unconstrained, 0.99 * side);
    }
  }
  EXPECT_GT(carved, 50) << "without the constraint the cylinder should be cut into";
}
