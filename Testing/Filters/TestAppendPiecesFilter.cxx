// SPDX-License-Identifier: BSD-3-Clause
#include "Support/PlainSettings.h"
#include "vtkAppendPiecesFilter.h"

#include "Support/ErrorObserver.h"
#include "Support/RandomMapBlocks.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cstring>

using namespace freespace;

TEST(vtkAppendPiecesFilter, PiecesTogetherAreTheWhole)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(100);
  for (const bool observed : { false, true })
  {
    contour->SetSharpEdges(observed);
    contour->SetObservedOnly(observed);
    contour->UpdateWholeExtent();
    vtkNew<vtkPolyData> whole;
    whole->ShallowCopy(contour->GetOutput());
    contour->SetObservedOnly(false);
    vtkNew<vtkAppendPiecesFilter> append;
    append->CrumbsOn();
    append->SetObservedOnly(observed);
    for (int piece = 0; piece < 3; ++piece)
    {
      contour->UpdatePiece(piece, 3, 0);
      vtkNew<vtkPolyData> part;
      part->ShallowCopy(contour->GetOutput());
      EXPECT_GT(part->GetNumberOfCells(), whole->GetNumberOfCells() / 10);
      append->AddInputData(part);
    }
    append->Update();
    vtkPolyData* joined = append->GetOutput();
    const auto expectSame = [](vtkDataArray* a, vtkDataArray* b)
    {
      ASSERT_TRUE(a && b);
      ASSERT_EQ(a->GetDataType(), b->GetDataType());
      ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
      const std::size_t bytes = a->GetNumberOfValues() * a->GetDataTypeSize();
      EXPECT_EQ(std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes), 0);
    };
    expectSame(joined->GetPoints()->GetData(), whole->GetPoints()->GetData());
    vtkNew<vtkCellArray> triangles; // of one type of integers
    triangles->DeepCopy(whole->GetPolys());
    triangles->ConvertTo64BitStorage();
    joined->GetPolys()->ConvertTo64BitStorage();
    expectSame(joined->GetPolys()->GetConnectivityArray(), triangles->GetConnectivityArray());
    expectSame(joined->GetCellData()->GetArray("View"), whole->GetCellData()->GetArray("View"));
    expectSame(joined->GetCellData()->GetArray("Kind"), whole->GetCellData()->GetArray("Kind"));
    EXPECT_FALSE(joined->GetPointGhostArray());
  }
}

TEST(vtkAppendPiecesFilter, TellsWhatIsWrong)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkAppendPiecesFilter> append;
  append->CrumbsOn();
  append->AddInputData(empty);
  append->Update();
  EXPECT_EQ(append->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkPolyData> square;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i == 1 || i == 2, i / 2, 0);
  }
  cells->InsertNextCell(4, corners);
  square->SetPoints(points);
  square->SetPolys(cells);
  append->AddInputData(square);
  vtkNew<ErrorObserver> errors;
  errors->Observe(append);
  append->Update();
  EXPECT_TRUE(errors->Has("cells that are not triangles")) << errors->All;
  EXPECT_EQ(append->GetOutput()->GetNumberOfPoints(), 0);
}
