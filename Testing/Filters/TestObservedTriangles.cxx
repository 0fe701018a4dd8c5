// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ObservedTriangles.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

using namespace freespace;

namespace
{

// Two triangles that share an edge, and one apart.
vtkSmartPointer<vtkPolyData> Three(const std::vector<int>& kinds, const std::vector<int>& supported)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 7; ++i)
  {
    points->InsertNextPoint(i, i % 2, 0);
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : { std::array<vtkIdType, 3>{ 4, 5, 6 }, { 0, 1, 2 }, { 2, 1, 3 } })
  {
    triangles->InsertNextCell(3, t.data());
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  vtkNew<vtkUnsignedCharArray> kind, support;
  kind->SetName("Kind");
  support->SetName(SupportedName);
  vtkNew<vtkIntArray> pointId, viewpoint;
  pointId->SetName("Id");
  viewpoint->SetName("CameraFromWorld");
  viewpoint->InsertNextValue(1);
  for (int i = 0; i < 3; ++i)
  {
    kind->InsertNextValue(kinds[i]);
    support->InsertNextValue(supported[i]);
  }
  for (int i = 0; i < 7; ++i)
  {
    pointId->InsertNextValue(i);
  }
  surface->GetCellData()->AddArray(kind);
  surface->GetCellData()->AddArray(support);
  surface->GetPointData()->AddArray(pointId);
  surface->GetFieldData()->AddArray(viewpoint);
  return surface;
}

}

TEST(ObservedTriangles, CrumbsWithoutSupportAreDropped)
{
  const auto crumb = Three({ 0, 0, 0 }, { 0, 0, 1 }), supported = Three({ 0, 0, 0 }, { 1, 0, 1 });
  DropCrumbs(crumb);
  DropCrumbs(supported);
  EXPECT_EQ(supported->GetNumberOfPolys(), 3);
  ASSERT_EQ(crumb->GetNumberOfPolys(), 2);
  EXPECT_EQ(crumb->GetNumberOfPoints(), 4);
  EXPECT_EQ(crumb->GetPoint(3)[0], 3);
  EXPECT_EQ(crumb->GetPointData()->GetArray("Id")->GetTuple1(3), 3);
  EXPECT_EQ(crumb->GetCellData()->GetArray(SupportedName)->GetTuple1(1), 1);
}

TEST(ObservedTriangles, KeepWhatFeaturesBearOutAndTheViewpoint)
{
  const auto surface = Three({ 2, 0, 1 }, { 1, 0, 0 });
  KeepObserved(surface);
  ASSERT_EQ(surface->GetNumberOfPolys(), 2);
  EXPECT_EQ(surface->GetCellData()->GetArray("Kind")->GetTuple1(0), 2);
  EXPECT_TRUE(surface->GetFieldData()->HasArray("CameraFromWorld"));
  vtkNew<vtkPolyData> plain;
  plain->DeepCopy(Three({ 1, 1, 1 }, { 0, 0, 0 }));
  plain->GetCellData()->Initialize();
  KeepObserved(plain);
  DropCrumbs(plain);
  EXPECT_EQ(plain->GetNumberOfPolys(), 3);
}
