// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewBlocks.h"
#include "Support/PlainSettings.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCommand.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphere.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

constexpr int Side = 30; // points of a wall, each way

// A view along z of a wall at a depth of 10 that is 3 wide, with a bump; and perhaps of three points very far
// behind it, at the image's corners.
DisparityMap Wall(double eyeX, bool withFar, int index)
{
  DisparityMap map;
  map.name = "view" + std::to_string(index);
  map.camera.K << 500, 0, 100, 0, 500, 100, 0, 0, 1;
  map.camera.width = map.camera.height = 200;
  map.camera.t = Vector3d(-eyeX, 0, 0);
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      const double across = 3.0 * x / (Side - 1) - 1.5, along = 3.0 * y / (Side - 1) - 1.5;
      const double bump = std::max(0.0, 0.5 - std::hypot(across, along));
      map.points.push_back({ across, along, 10 - bump });
      const int i = y * Side + x;
      if (x > 0 && y > 0)
      {
        map.triangles.push_back({ i - Side - 1, i - Side, i });
        map.triangles.push_back({ i - Side - 1, i, i - 1 });
      }
    }
  }
  if (withFar)
  {
    const int n = static_cast<int>(map.points.size());
    map.points.insert(
      map.points.end(), { { -190, -190, 1000 }, { -120, -190, 1000 }, { -190, -120, 1000 } });
    map.triangles.push_back({ n, n + 1, n + 2 });
  }
  for (const Vector3d& point : map.points)
  {
    map.imagePoints.push_back(map.camera.Project(point));
  }
  map.sourceView.assign(map.points.size(), index);
  return map;
}

vtkSmartPointer<vtkMultiBlockDataSet> TwoViews(bool withFar)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (int i = 0; i < 2; ++i)
  {
    const DisparityMap map = Wall(i - 0.5, withFar && i == 0, i);
    SetNamedBlock(blocks, blocks->GetNumberOfBlocks(), map.name, BlockFromMap(map));
  }
  return blocks;
}

double Longest(vtkFreespaceUnion* phi)
{
  double b[6];
  phi->GetBounds(b);
  return std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
}

}

TEST(FreespaceRegion, IsNotStretchedByAFewFarFeatures)
{
  vtkNew<vtkFreespaceUnion> phi, near;
  SetPlain(phi.Get());
  SetPlain(near.Get());
  phi->SetMaps(TwoViews(true));
  near->SetMaps(TwoViews(false));
  double found[6], expected[6];
  phi->GetBounds(found);
  near->GetBounds(expected);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
  }
  EXPECT_EQ(phi->GetNumberOfFeatures(), 2 * Side * Side + 3);
  EXPECT_EQ(phi->GetNumberOfFeaturesBeyond(), 3);
  EXPECT_EQ(near->GetNumberOfFeaturesBeyond(), 0);
}

TEST(FreespaceRegion, CanBeTheWholeOrABox)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(TwoViews(true));
  phi->SetRegionModeToWhole();
  EXPECT_GT(Longest(phi), 900);
  EXPECT_EQ(phi->GetNumberOfFeaturesBeyond(), 0);
  phi->SetRegion(-1, 1, -1, 1, 0, 20);
  EXPECT_LT(Longest(phi), 2.2);
  double bounds[6];
  phi->GetRegionBounds(bounds);
  EXPECT_GE(bounds[0], -1);
  EXPECT_LE(bounds[1], 1);
  const double beside[3] = { 1.3, 0, 10.001 };
  EXPECT_TRUE(phi->IsPointFree(beside)) << "beyond the region all is free";
}

TEST(FreespaceRegion, FeaturesBeyondItStillCarve)
{
  // The far triangle is seen past the wall: what of the region lies before it is free.
  const DisparityMap wall = Wall(0, false, 0);
  DisparityMap far = Wall(0, false, 1);
  far.points = { { -300, -300, 1000 }, { 300, -300, 1000 }, { 0, 300, 1000 } };
  far.imagePoints.clear();
  for (const Vector3d& point : far.points)
  {
    far.imagePoints.push_back(far.camera.Project(point));
  }
  far.triangles = { { 0, 1, 2 } };
  far.sourceView.assign(3, 1);
  vtkNew<vtkMultiBlockDataSet> maps;
  SetNamedBlock(maps, 0, wall.name, BlockFromMap(wall));
  SetNamedBlock(maps, 1, far.name, BlockFromMap(far));
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(maps);
  const double inWall[3] = { 0, 0, 9.9 };
  EXPECT_TRUE(phi->IsPointFree(inWall));
  EXPECT_EQ(phi->GetNumberOfFeaturesBeyond(), 3);
  EXPECT_LT(Longest(phi), 4);
}

TEST(FreespaceRegion, ThatHoldsNothingIsAnError)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(TwoViews(false));
  phi->SetRegion(100, 101, 0, 1, 0, 1);
  int errors = 0;
  phi->AddObserver(vtkCommand::ErrorEvent, phi.Get(), &vtkFreespaceUnion::Modified);
  const vtkMTimeType before = phi->GetMTime();
  EXPECT_FALSE(phi->IsValid());
  errors = phi->GetMTime() > before;
  EXPECT_EQ(errors, 1);
}

TEST(FreespaceRegion, TheLatticeGoesByTheFeatures)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(TwoViews(true));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCellsToAutomatic();
  EXPECT_EQ(contour->FindCells(), phi->GetSuggestedCells());
  EXPECT_GE(contour->FindCells(), 256);
  contour->SetMemoryLimit(0.5);
  const int fewer = contour->FindCells();
  EXPECT_LT(fewer, phi->GetSuggestedCells());
  EXPECT_GT(fewer, 2);
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfPolys(), 0) << "it fits into the limit";
  vtkNew<vtkSphere> sphere;
  vtkNew<vtkBisectionContourFilter> other;
  SetPlainContour(other.Get());
  other->SetImplicitFunction(sphere);
  other->SetBounds(-1, 1, -1, 1, -1, 1);
  other->SetCellsToAutomatic();
  EXPECT_EQ(other->FindCells(), 256);
}
