// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMergeViewsFilter.h"

#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

View MakeNamedView(const std::string& name, const std::string& image, int points, double x)
{
  View view;
  view.name = name;
  view.imageFile = image;
  view.camera.K << 100, 0, 50, 0, 100, 40, 0, 0, 1;
  view.camera.t = { 0.1, 0.2, 0.3 };
  view.camera.width = 100;
  view.camera.height = 80;
  for (int i = 0; i < points; ++i)
  {
    view.points.push_back({ x, 0.01 * i, 2 });
    view.imagePoints.push_back(view.camera.Project(view.points.back()));
  }
  return view;
}

vtkSmartPointer<vtkMultiBlockDataSet> ViewBlocksOf(const std::vector<View>& views)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    SetNamedBlock(blocks, static_cast<unsigned int>(i), views[i].name, BlockFromView(views[i]));
  }
  return blocks;
}

void AddArray(vtkMultiBlockDataSet* blocks, unsigned int index, const char* name, double value)
{
  auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(index));
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(block->GetNumberOfPoints());
  array->Fill(value);
  block->GetPointData()->AddArray(array);
}

}

TEST(MergeViewsFilter, OneImageBecomesOneView)
{
  const auto sparse =
    ViewBlocksOf({ MakeNamedView("a.jpg", "a.jpg", 4, 0), MakeNamedView("b.jpg", "b.jpg", 3, 0) });
  const auto stereo = ViewBlocksOf(
    { MakeNamedView("cluster1", "b.jpg", 5, 1), MakeNamedView("cluster2", "c.jpg", 2, 1) });
  AddArray(sparse, 1, "Common", 1);
  AddArray(stereo, 0, "Common", 2);
  AddArray(sparse, 1, "Own", 1);
  const vtkIdType chain[2] = { 1, 3 };
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(2, chain);
  vtkPolyData::SafeDownCast(stereo->GetBlock(0))->SetLines(lines);
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(sparse);
  merge->AddInputDataObject(stereo);
  merge->Update();
  const std::vector<View> views = ViewsFromBlocks(merge->GetOutput());
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[0].name, "a.jpg");
  EXPECT_EQ(views[1].name, "b.jpg");
  EXPECT_EQ(views[2].name, "cluster2");
  ASSERT_EQ(views[1].points.size(), 8u);
  EXPECT_EQ(views[1].points[0], Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(views[1].points[3], Eigen::Vector3d(1, 0, 2));
  EXPECT_EQ(views[1].imagePoints[4], views[1].camera.Project(views[1].points[4]));
  auto* block = vtkPolyData::SafeDownCast(merge->GetOutput()->GetBlock(1));
  ASSERT_TRUE(block->GetPointData()->HasArray("Common"));
  EXPECT_EQ(block->GetPointData()->GetArray("Common")->GetComponent(2, 0), 1);
  EXPECT_EQ(block->GetPointData()->GetArray("Common")->GetComponent(3, 0), 2);
  EXPECT_FALSE(block->GetPointData()->HasArray("Own"));
  ASSERT_EQ(block->GetNumberOfLines(), 1);
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  block->GetLines()->GetCellAtId(0, size, ids);
  EXPECT_EQ(ids[0], 3 + 1);
  EXPECT_EQ(ids[1], 3 + 3);
}

TEST(MergeViewsFilter, OtherCamerasStayApart)
{
  std::vector<View> views = { MakeNamedView("one", "a.jpg", 4, 0),
    MakeNamedView("two", "a.jpg", 3, 0) };
  views[1].camera.t.x() += 1e-3;
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(ViewBlocksOf(views));
  merge->Update();
  EXPECT_EQ(merge->GetOutput()->GetNumberOfBlocks(), 2u);
}

TEST(MergeViewsFilter, ViewsWithoutAnImageStayApart)
{
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(
    ViewBlocksOf({ MakeNamedView("one", "", 4, 0), MakeNamedView("two", "", 3, 0) }));
  merge->Update();
  EXPECT_EQ(merge->GetOutput()->GetNumberOfBlocks(), 2u);
}

TEST(MergeViewsFilter, EmptyInputAndEmptyViews)
{
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(ViewBlocksOf({}));
  merge->AddInputDataObject(
    ViewBlocksOf({ MakeNamedView("a", "a.jpg", 0, 0), MakeNamedView("b", "a.jpg", 2, 0) }));
  merge->Update();
  ASSERT_EQ(merge->GetOutput()->GetNumberOfBlocks(), 1u);
  EXPECT_EQ(vtkPolyData::SafeDownCast(merge->GetOutput()->GetBlock(0))->GetNumberOfPoints(), 2);
}

TEST(MergeViewsFilter, BlockThatIsNoView)
{
  ExpectedErrors errors;
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(ViewBlocksOf({ MakeNamedView("a", "a.jpg", 2, 0) }));
  merge->AddInputDataObject(blocks);
  merge->Update();
  EXPECT_TRUE(errors.Has("View 'block 0' has no array CameraIntrinsics"));
  EXPECT_EQ(merge->GetOutput()->GetNumberOfBlocks(), 0u);
}
