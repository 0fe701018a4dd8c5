// SPDX-License-Identifier: BSD-3-Clause
#include "Report/TruthComparison.h"

#include "Common/Error.h"

#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

constexpr double depth = 2;

// A camera that looks straight at planes z = const, from the origin along +z.
Camera Front()
{
  Camera camera;
  camera.K << 100, 0, 50, 0, 100, 40, 0, 0, 1;
  camera.width = 100;
  camera.height = 80;
  return camera;
}

// A square with its middle before the camera.
vtkSmartPointer<vtkPolyData> Square(double z, double left = -3, double right = 3)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(left, -3, z);
  plane->SetPoint1(right, -3, z);
  plane->SetPoint2(left, 3, z);
  plane->Update();
  return plane->GetOutput();
}

// Features whose hull holds the box |x|, |y| <= half about the true plane.
std::vector<Eigen::Vector3d> HullOf(double half)
{
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
  {
    corners.emplace_back(
      i & 1 ? half : -half, i & 2 ? half : -half, depth + (i & 4 ? half : -half));
  }
  return corners;
}

}

TEST(TruthComparison, OfTheTruthWithItselfIsPerfect)
{
  const TruthFigures figures =
    CompareWithTruth(Square(depth), Square(depth), { Front() }, HullOf(5));
  EXPECT_EQ(figures.rays, 8000u) << "every pixel";
  EXPECT_NEAR(figures.medianDepth, depth, 1e-6);
  EXPECT_NEAR(figures.medianError, 0, 1e-9);
  EXPECT_EQ(figures.covered, 1);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(figures.within[i], 1, 1e-9);
    EXPECT_NEAR(figures.accuracy[i], 1, 1e-9);
    EXPECT_NEAR(figures.completeness[i], 1, 1e-9);
    EXPECT_NEAR(figures.F(i), 1, 1e-9);
  }
  EXPECT_EQ(figures.carved + figures.bulging, 0);
}

TEST(TruthComparison, TellsBehindFromInFront)
{
  // 0.3 % of the depth: more than the second limit, less than the third; 1 %: more than all.
  const TruthFigures behind =
    CompareWithTruth(Square(1.003 * depth), Square(depth), { Front() }, HullOf(5));
  EXPECT_NEAR(behind.within[1], 0, 1e-9);
  EXPECT_NEAR(behind.accuracy[1], 0, 1e-9);
  EXPECT_NEAR(behind.accuracy[2], 1, 1e-9);
  EXPECT_NEAR(behind.completeness[2], 1, 1e-9);
  EXPECT_GT(behind.medianError, 0.003 * depth) << "along the ray, which is longer";
  EXPECT_LT(behind.medianError, 0.0036 * depth);
  const TruthFigures carved =
    CompareWithTruth(Square(1.01 * depth), Square(depth), { Front() }, HullOf(5));
  EXPECT_NEAR(carved.carved, 1, 1e-3) << "but for pixels on the diagonal";
  EXPECT_EQ(carved.bulging, 0);
  const TruthFigures bulging =
    CompareWithTruth(Square(0.99 * depth), Square(depth), { Front() }, HullOf(5));
  EXPECT_NEAR(bulging.bulging, 1, 1e-3);
  EXPECT_EQ(bulging.carved, 0);
  EXPECT_EQ(bulging.F(2), 0);
}

TEST(TruthComparison, CountsWhatIsMissing)
{
  const TruthFigures half =
    CompareWithTruth(Square(depth, -3, 0), Square(depth), { Front() }, HullOf(5));
  EXPECT_NEAR(half.covered, 0.5, 1e-9);
  EXPECT_NEAR(half.within[2], 0.5, 1e-9);
  EXPECT_NEAR(half.accuracy[0], 1, 1e-9) << "what there is is right";
  EXPECT_NEAR(half.completeness[0], 0.5, 0.02);
  EXPECT_NEAR(half.F(0), 2.0 / 3, 0.02);
}

TEST(TruthComparison, LeavesOutWhatIsOutsideOfTheHull)
{
  const TruthFigures figures =
    CompareWithTruth(Square(depth, -3, 0), Square(depth), { Front() }, HullOf(0.5));
  EXPECT_EQ(figures.rays, 50u * 50u) << "|x| <= 0.5 at depth 2 is 50 pixels";
}

TEST(TruthComparison, RefusesATruthThatNoRayMeets)
{
  EXPECT_THROW(CompareWithTruth(Square(depth), Square(-depth), { Front() }, HullOf(5)), Error);
  EXPECT_THROW(CompareWithTruth(Square(depth), Square(depth), {}, HullOf(5)), Error);
  EXPECT_THROW(CompareWithTruth(Square(depth), Square(depth), { Front() }, {}), Error);
  vtkNew<vtkPolyData> empty;
  EXPECT_THROW(CompareWithTruth(Square(depth), empty, { Front() }, HullOf(5)), Error);
}

TEST(TruthComparison, TakesAnEmptySurface)
{
  vtkNew<vtkPolyData> empty;
  const TruthFigures figures = CompareWithTruth(empty, Square(depth), { Front() }, HullOf(5));
  EXPECT_EQ(figures.covered, 0);
  EXPECT_EQ(figures.completeness[2], 0);
  EXPECT_EQ(figures.accuracy[2], 0);
  EXPECT_EQ(figures.F(2), 0);
}
