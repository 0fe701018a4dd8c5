// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayDisparityFilter.h"
#include "vtkOutlierFilter.h"

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

vtkSmartPointer<vtkMultiBlockDataSet> BlocksWith(const View& view)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  SetNamedBlock(blocks, 0, view.name, BlockFromView(view));
  return blocks;
}

vtkPolyData* FirstBlock(vtkOutlierFilter* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutput()->GetBlock(0));
}

}

TEST(OutlierFilter, DropsTheOutlierWithItsPartsOfTheChain)
{
  const View view = RowWithAnOutlier();
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(BlocksWith(view));
  filter->SetSupportRadius(2); // of a row, whose box is empty, one pixel
  filter->SetSupport(1);
  ASSERT_EQ(ErrorOfUpdate(filter), "");
  vtkPolyData* output = FirstBlock(filter);
  ASSERT_EQ(output->GetNumberOfPoints(), 5);
  EXPECT_EQ(output->GetNumberOfVerts(), 5);
  EXPECT_EQ(output->GetNumberOfLines(), 3) << "0-1, 1-2 and 4-5";
  vtkDataArray* pixels = output->GetPointData()->GetArray("ImagePoint");
  const int kept[5] = { 0, 1, 2, 4, 5 };
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(pixels->GetComponent(i, 0), 500 + kept[i]);
    EXPECT_EQ(Eigen::Vector3d(output->GetPoint(i)), view.points[kept[i]]);
  }
  EXPECT_EQ(ViewFromBlock(output, "v").camera.K, view.camera.K);
}

TEST(OutlierFilter, TwoNeighboursAreMoreThanTheEndsOfARowHave)
{
  View view = RowWithAnOutlier();
  view.points[3] = view.camera.Unproject({ 503, 500 }, 2);
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(BlocksWith(view));
  filter->SetSupportRadius(2);
  filter->SetSupport(2);
  ASSERT_EQ(ErrorOfUpdate(filter), "");
  ASSERT_EQ(FirstBlock(filter)->GetNumberOfPoints(), 4);
  EXPECT_EQ(Eigen::Vector3d(FirstBlock(filter)->GetPoint(0)), view.points[1]);
  filter->SetSupport(0); // keeps all
  filter->Update();
  EXPECT_EQ(FirstBlock(filter)->GetNumberOfPoints(), 6);
}

// The defaults are those of the step of vtkDelaunayDisparityFilter, with the neighbourhood of the triangulation.
TEST(OutlierFilter, NeighboursOfTheTriangulation)
{
  View view = MakeView();
  for (int i = 0; i < 49; ++i)
  {
    AddFeature(view, Eigen::Vector2d(400 + 20 * (i % 7), 400 + 21 * (i / 7)), i == 24 ? 1.5 : 2);
  }
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(BlocksWith(view));
  ASSERT_EQ(ErrorOfUpdate(filter), "");
  ASSERT_EQ(FirstBlock(filter)->GetNumberOfPoints(), 48);
  for (vtkIdType i = 0; i < 48; ++i)
  {
    EXPECT_EQ(Eigen::Vector3d(FirstBlock(filter)->GetPoint(i)), view.points[i < 24 ? i : i + 1]);
  }
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputDataObject(BlocksWith(view));
  maps->SetFeatureSpacing(0);
  maps->Update();
  auto* map = vtkPolyData::SafeDownCast(maps->GetOutput()->GetBlock(0));
  ASSERT_EQ(map->GetNumberOfPoints(), 48);
  for (vtkIdType i = 0; i < 48; ++i)
  {
    EXPECT_EQ(Eigen::Vector3d(map->GetPoint(i)), view.points[i < 24 ? i : i + 1]);
  }
}

TEST(OutlierFilter, FeaturesThatAreNotFiniteAreDropped)
{
  View view = RowWithAnOutlier();
  view.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(BlocksWith(view));
  filter->SetSupportRadius(2);
  filter->SetSupport(1);
  filter->Update();
  EXPECT_EQ(FirstBlock(filter)->GetNumberOfPoints(), 4) << "it and the outlier go";
}

TEST(OutlierFilter, BadInputIsAnError)
{
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(BlocksWith(RowWithAnOutlier()));
  filter->SetSupportRadius(-1);
  EXPECT_NE(ErrorOfUpdate(filter), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  filter->SetSupportRadius(2);
  EXPECT_EQ(ErrorOfUpdate(filter), "");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  filter->SetInputDataObject(blocks);
  const std::string error = ErrorOfUpdate(filter);
  EXPECT_NE(error.find("has no array CameraIntrinsics"), std::string::npos) << error;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(OutlierFilter, NoViewsGiveNone)
{
  vtkNew<vtkOutlierFilter> filter;
  filter->SetInputDataObject(vtkNew<vtkMultiBlockDataSet>());
  EXPECT_EQ(ErrorOfUpdate(filter), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}
