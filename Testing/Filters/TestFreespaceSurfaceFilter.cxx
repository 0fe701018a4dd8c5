// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceSurfaceFilter.h"

#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"

#include <vtkBisectionContourFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFitSurfaceFilter.h>
#include <vtkFreespaceUnion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>

#include <gtest/gtest.h>

#include <vector>

namespace
{

vtkSmartPointer<vtkMultiBlockDataSet> MakeTwoMaps(unsigned int seed)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const std::vector<freespace::DisparityMap> maps = freespace::RandomMaps(seed, 3);
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    freespace::SetNamedBlock(blocks, static_cast<unsigned int>(i), "view" + std::to_string(i),
      freespace::BlockFromMap(maps[i]));
  }
  return blocks;
}

// Points and corners of triangles, one after the other.
std::vector<double> NumbersOf(vtkPolyData* surface)
{
  std::vector<double> numbers;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    numbers.insert(numbers.end(), point, point + 3);
  }
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    vtkIdType size;
    const vtkIdType* corners;
    surface->GetPolys()->GetCellAtId(t, size, corners);
    numbers.insert(numbers.end(), corners, corners + size);
  }
  return numbers;
}

void Count(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

}

TEST(FreespaceSurfaceFilter, IsTheContourOfTheUnion)
{
  for (unsigned int seed = 0; seed < 2; ++seed)
  {
    const auto maps = MakeTwoMaps(seed);
    vtkNew<vtkFreespaceUnion> phi;
    phi->SetMaps(maps);
    phi->SetHullMargin(1.25 / 32); // of the 32 cells
    phi->SetMinimumViewsToAutomatic();
    vtkNew<vtkBisectionContourFilter> contour;
    contour->SetImplicitFunction(phi);
    contour->SetCells(32);
    contour->SharpEdgesOn();
    contour->CrumbsOff();
    contour->Update();
    vtkNew<vtkFitSurfaceFilter> fit;
    fit->SetInputConnection(0, contour->GetOutputPort());
    fit->SetInputDataObject(1, maps);
    fit->Update();
    vtkNew<vtkFreespaceSurfaceFilter> surface;
    surface->SetInputDataObject(maps);
    surface->SetCells(32);
    surface->Update();
    ASSERT_GT(surface->GetOutput()->GetNumberOfPolys(), 100);
    EXPECT_EQ(NumbersOf(surface->GetOutput()), NumbersOf(fit->GetOutput()));
    surface->FitSurfaceOff();
    surface->Update();
    EXPECT_EQ(NumbersOf(surface->GetOutput()), NumbersOf(contour->GetOutput()));
  }
}

TEST(FreespaceSurfaceFilter, RunsAgainOnlyAfterAChange)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(MakeTwoMaps(1));
  vtkNew<vtkFreespaceSurfaceFilter> surface;
  surface->SetInputConnection(producer->GetOutputPort());
  surface->SetCells(16);
  int runs = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetCallback(Count);
  count->SetClientData(&runs);
  surface->AddObserver(vtkCommand::EndEvent, count);
  surface->Update();
  surface->Update();
  EXPECT_EQ(runs, 1);
  const std::vector<double> coarse = NumbersOf(surface->GetOutput());
  surface->SetCells(24);
  surface->Update();
  EXPECT_EQ(runs, 2);
  EXPECT_NE(NumbersOf(surface->GetOutput()), coarse);
  surface->GetFreespaceUnion()->SetMinimumViews(2);
  surface->Update();
  EXPECT_EQ(runs, 3);
  producer->SetOutput(MakeTwoMaps(2));
  surface->Update();
  EXPECT_EQ(runs, 4);
}

TEST(FreespaceSurfaceFilter, PiecesAreTheWhole)
{
  vtkNew<vtkFreespaceSurfaceFilter> surface;
  surface->SetInputDataObject(MakeTwoMaps(3));
  surface->SetCells(32);
  surface->GetContour()->CrumbsOn(); // only a whole surface can leave them out
  surface->FitSurfaceOff();
  surface->Update();
  const vtkIdType whole = surface->GetOutput()->GetNumberOfPolys();
  vtkIdType sum = 0;
  for (int piece = 0; piece < 3; ++piece)
  {
    surface->UpdatePiece(piece, 3, 0);
    sum += surface->GetOutput()->GetNumberOfPolys();
  }
  EXPECT_EQ(sum, whole);
}

TEST(FreespaceSurfaceFilter, TellsErrorsAsItsOwn)
{
  vtkNew<vtkFreespaceSurfaceFilter> surface;
  surface->SetInputDataObject(MakeTwoMaps(1));
  surface->SetMinimumViews(100);
  int errors = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetCallback(Count);
  count->SetClientData(&errors);
  surface->AddObserver(vtkCommand::ErrorEvent, count);
  surface->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, count);
  surface->Update();
  EXPECT_EQ(errors, 2); // the filter's, and its executive's that it failed
  EXPECT_EQ(surface->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(FreespaceSurfaceFilter, HearsAnAbort)
{
  vtkNew<vtkFreespaceSurfaceFilter> surface;
  surface->SetInputDataObject(MakeTwoMaps(1));
  surface->SetCells(64);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  surface->AddObserver(vtkCommand::ProgressEvent, abort);
  surface->Update();
  EXPECT_EQ(surface->GetOutput()->GetNumberOfPoints(), 0);
}
