// SPDX-License-Identifier: BSD-3-Clause
#include "Support/PlainSettings.h"
#include "vtkSimplifySurfaceFilter.h"

#include "Support/ErrorObserver.h"
#include "Support/RandomMapBlocks.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

TEST(vtkSimplifySurfaceFilter, LeavesOutTrianglesAndKeepsLabels)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(40);
  vtkNew<vtkSimplifySurfaceFilter> simplify;
  simplify->SetInputConnection(contour->GetOutputPort());
  double bounds[6];
  phi->GetBounds(bounds);
  simplify->SetDistance(2e-3 * (bounds[1] - bounds[0]));
  simplify->Update();
  vtkPolyData *before = contour->GetOutput(), *after = simplify->GetOutput();
  EXPECT_LT(after->GetNumberOfCells(), before->GetNumberOfCells() * 9 / 10);
  EXPECT_GT(after->GetNumberOfCells(), 100);
  for (const char* name : { "View", "Kind" })
  {
    vtkDataArray* array = after->GetCellData()->GetArray(name);
    ASSERT_TRUE(array) << name;
    EXPECT_EQ(array->GetDataType(), before->GetCellData()->GetArray(name)->GetDataType());
    EXPECT_EQ(array->GetRange()[0], before->GetCellData()->GetArray(name)->GetRange()[0]);
    EXPECT_EQ(array->GetRange()[1], before->GetCellData()->GetArray(name)->GetRange()[1]);
  }
  EXPECT_EQ(after->GetPoints()->GetDataType(), before->GetPoints()->GetDataType());
  ExpectedErrors errors;
  simplify->SetDistance(0);
  EXPECT_FALSE(simplify->GetExecutive()->Update());
  EXPECT_TRUE(errors.Has("it must be a length above 0"));
  EXPECT_EQ(simplify->GetOutput()->GetNumberOfCells(), 0);
}
