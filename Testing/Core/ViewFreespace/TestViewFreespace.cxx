// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/ViewFreespace.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// A camera at the origin that looks along +z.
DisparityMap MapOf(const std::vector<Vector3d>& points)
{
  DisparityMap map;
  map.camera.K << 100, 0, 50, 0, 100, 50, 0, 0, 1;
  map.camera.width = map.camera.height = 100;
  map.points = points;
  for (const Vector3d& point : points)
  {
    map.imagePoints.push_back(map.camera.Project(point));
  }
  map.sourceView.assign(points.size(), 0);
  return map;
}

void ExpectNothingClaimed(const ViewFreespace& view)
{
  EXPECT_EQ(view.NumberOfTriangles(), 0u);
  const AlignedBox3d box(Vector3d(-0.1, -0.1, 0.5), Vector3d(0.1, 0.1, 0.7));
  for (const Vector3d& point : { Vector3d(0, 0, 0.5), Vector3d(0.1, 0.1, 2), Vector3d(0, 0, -1) })
  {
    EXPECT_FALSE(view.IsFree(point));
    EXPECT_EQ(view.At(point).triangle, -1);
  }
  ViewFreespace::Intervals intervals = { { 0, 1 } };
  view.FreeIntervals(Vector3d(-1, 0, 1), Vector3d(1, 0, 1), intervals);
  EXPECT_TRUE(intervals.empty());
  EXPECT_EQ(view.Classify(box), BoxContent::Matter);
  EXPECT_EQ(view.ClassifyFinely(box), BoxContent::Matter);
  EXPECT_FALSE(view.MayClaim(box));
}

}

TEST(ViewFreespace, WithoutTrianglesClaimsNothing)
{
  ExpectNothingClaimed(ViewFreespace(MapOf({})));
  ExpectNothingClaimed(ViewFreespace(MapOf({ Vector3d(0, 0, 1) })));
}

TEST(ViewFreespace, TrianglesWithoutAreaClaimNothing)
{
  // All on one viewing plane, through the pixels that are asked for.
  DisparityMap map = MapOf({ Vector3d(-0.3, 0, 1), Vector3d(0, 0, 1), Vector3d(0.6, 0, 2) });
  map.triangles = { { 0, 1, 2 }, { 0, 0, 1 } };
  ExpectNothingClaimed(ViewFreespace(map));
  map.imagePoints.assign(3, Vector2d(50, 50));
  ExpectNothingClaimed(ViewFreespace(map));
}

TEST(ViewFreespace, TrianglesBehindTheCameraClaimNothing)
{
  DisparityMap map = MapOf({ Vector3d(-1, -1, 1), Vector3d(1, -1, 1), Vector3d(0, 1, -1) });
  map.triangles = { { 0, 1, 2 } };
  ExpectNothingClaimed(ViewFreespace(map));
}

TEST(ViewFreespace, OneTriangleHasTheDepthOfItsPlane)
{
  DisparityMap map = MapOf({ Vector3d(-1, -1, 4), Vector3d(1, -1, 4), Vector3d(0, 1, 4) });
  map.triangles = { { 0, 1, 2 } };
  const ViewFreespace view(map);
  const ViewFreespace::Sample sample = view.At(Vector3d(0, 0, 3));
  EXPECT_EQ(sample.triangle, 0);
  EXPECT_NEAR(sample.value, 1, 1e-12);
  EXPECT_NEAR((sample.gradient - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
  EXPECT_TRUE(view.IsFree(Vector3d(0, 0, 3.999)));
  EXPECT_FALSE(view.IsFree(Vector3d(0, 0, 4.001)));
  EXPECT_FALSE(view.IsFree(Vector3d(1.5, 0, 4))) << "beside the triangle";
  ViewFreespace::Intervals intervals;
  view.FreeIntervals(Vector3d(0, 0, 2), Vector3d(0, 0, 6), intervals);
  ASSERT_EQ(intervals.size(), 1u);
  EXPECT_NEAR(intervals[0].first, 0, 1e-12);
  EXPECT_NEAR(intervals[0].second, 0.5, 1e-12);
}
