// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureSupportFilter.h"

#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"
#include "Support/FeatureViews.h"

#include <vtkCellArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <limits>

using namespace freespace;

namespace
{

// Five features in a row, a pixel apart, and in their middle one at half the depth; a chain over all.
View RowWithAnOutlier()
{
  View view = MakeView();
  for (int i = 0; i < 6; ++i)
  {
    AddFeature(view, Eigen::Vector2d(500 + i, 500), i == 3 ? 1 : 2);
    if (i > 0)
    {
      view.edges.push_back({ i - 1, i });
    }
  }
  return view;
}

vtkSmartPointer<vtkMultiBlockDataSet> Blocks(const View& view)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  SetNamedBlock(blocks, 0, view.name, BlockFromView(view));
  return blocks;
}

vtkPolyData* FirstBlock(vtkFeatureSupportFilter* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutput()->GetBlock(0));
}

}

TEST(FeatureSupportFilter, DropsTheOutlierWithItsPartsOfTheChain)
{
  const View view = RowWithAnOutlier();
  vtkNew<vtkFeatureSupportFilter> filter;
  filter->SetInputDataObject(Blocks(view));
  filter->SetRadius(10);
  filter->SetMinimumNeighbors(2);
  ASSERT_EQ(ErrorOfUpdate(filter), "");
  vtkPolyData* output = FirstBlock(filter);
  ASSERT_EQ(output->GetNumberOfPoints(), 5);
  EXPECT_EQ(output->GetNumberOfVerts(), 5);
  EXPECT_EQ(output->GetNumberOfLines(), 3) << "0-1, 1-2 and 4-5";
  vtkDataArray* support = output->GetPointData()->GetArray("Support");
  vtkDataArray* pixels = output->GetPointData()->GetArray("ImagePoint");
  const int kept[5] = { 0, 1, 2, 4, 5 };
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(support->GetTuple1(i), 4) << "the other four";
    EXPECT_EQ(pixels->GetComponent(i, 0), 500 + kept[i]);
    EXPECT_EQ(Eigen::Vector3d(output->GetPoint(i)), view.points[kept[i]]);
  }
  EXPECT_EQ(ViewFromBlock(output, "v").camera.K, view.camera.K);
}

TEST(FeatureSupportFilter, RadiusInPixels)
{
  vtkNew<vtkFeatureSupportFilter> filter;
  filter->SetInputDataObject(Blocks(RowWithAnOutlier()));
  filter->SetRadius(1);
  filter->Update();
  // Without a minimum all are kept, with their neighbours of their own depth a pixel away.
  const int next[6] = { 1, 2, 1, 0, 1, 1 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(FirstBlock(filter)->GetPointData()->GetArray("Support")->GetTuple1(i), next[i]) << i;
  }
}

TEST(FeatureSupportFilter, FeaturesThatAreNotFiniteAreDropped)
{
  View view = RowWithAnOutlier();
  view.points[1].x() = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkFeatureSupportFilter> filter;
  filter->SetInputDataObject(Blocks(view));
  filter->Update();
  EXPECT_EQ(FirstBlock(filter)->GetNumberOfPoints(), 5);
}

TEST(FeatureSupportFilter, BadInputIsAnError)
{
  vtkNew<vtkFeatureSupportFilter> filter;
  filter->SetInputDataObject(Blocks(RowWithAnOutlier()));
  filter->SetRadius(-1);
  EXPECT_NE(ErrorOfUpdate(filter), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  filter->SetRadius(4);
  EXPECT_EQ(ErrorOfUpdate(filter), "");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  filter->SetInputDataObject(blocks);
  const std::string error = ErrorOfUpdate(filter);
  EXPECT_NE(error.find("has no array CameraIntrinsics"), std::string::npos) << error;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(FeatureSupportFilter, NoViewsGiveNone)
{
  vtkNew<vtkFeatureSupportFilter> filter;
  filter->SetInputDataObject(vtkNew<vtkMultiBlockDataSet>());
  EXPECT_EQ(ErrorOfUpdate(filter), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}
