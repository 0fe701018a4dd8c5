// SPDX-License-Identifier: BSD-3-Clause
// vtkBisectionContourFilter with Incremental, over a union whose views come and go.
#include "vtkBisectionContourFilter.h"

#include "Support/RandomMapBlocks.h"
#include "vtkFreespaceUnion.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <random>
#include <string>

using namespace freespace;

namespace
{

void ExpectSameArray(vtkDataArray* a, vtkDataArray* b)
{
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->GetDataType(), b->GetDataType());
  ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      ASSERT_EQ(a->GetComponent(i, c), b->GetComponent(i, c)) << i;
    }
  }
}

void ExpectSameSurface(vtkPolyData* a, vtkPolyData* b)
{
  ASSERT_GT(a->GetNumberOfPolys(), 0);
  ExpectSameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData());
  ExpectSameArray(a->GetPolys()->GetConnectivityArray(), b->GetPolys()->GetConnectivityArray());
  for (const char* name : { "View", "Kind", "Supported" })
  {
    ExpectSameArray(a->GetCellData()->GetArray(name), b->GetCellData()->GetArray(name));
  }
  ExpectSameArray(a->GetPointData()->GetNormals(), b->GetPointData()->GetNormals());
}

// A contour with other settings than the defaults, for a seed.
void SetContour(vtkFreespaceUnion* phi, vtkBisectionContourFilter* contour, unsigned int seed)
{
  phi->SetHullMargin(0.02);
  phi->SetMinimumViews(seed % 3 == 1 ? 1 : -1);
  contour->SetImplicitFunction(phi);
  contour->SetCells(48);
  contour->SetSharpEdges(seed % 2);
  contour->ComputeNormalsOn();
  if (seed % 4 < 3)
  {
    contour->SetBounds(-1.1, 1.2, -1.0, 1.1, -1.2, 1.1);
  }
}

// The surface of the same maps without a past.
void ExpectAsFromNothing(vtkFreespaceUnion* phi, vtkPolyData* surface, unsigned int seed)
{
  vtkNew<vtkMultiBlockDataSet> copy;
  copy->DeepCopy(phi->GetMaps());
  vtkNew<vtkFreespaceUnion> freshPhi;
  vtkNew<vtkBisectionContourFilter> fresh;
  SetContour(freshPhi, fresh, seed);
  freshPhi->SetMaps(copy);
  fresh->Update();
  ExpectSameSurface(surface, fresh->GetOutput());
}

}

TEST(IncrementalContour, IsThatFromNothing)
{
  for (unsigned int seed = 0; seed < 6; ++seed)
  {
    std::mt19937 random(seed);
    const auto maps = MakeMaps(seed, 7);
    const auto mapAt = [&](unsigned int i) { return vtkPolyData::SafeDownCast(maps->GetBlock(i)); };
    vtkNew<vtkFreespaceUnion> phi;
    vtkNew<vtkBisectionContourFilter> contour;
    SetContour(phi, contour, seed);
    contour->IncrementalOn();
    phi->SetMaps(maps);
    for (int step = 0; step < 5; ++step)
    {
      contour->Update();
      ExpectAsFromNothing(phi, contour->GetOutput(), seed);
      const unsigned int view = static_cast<unsigned int>(random() % 7);
      const std::string name = "map" + std::to_string(view);
      if (step % 2 == 0)
      {
        ASSERT_TRUE(
          phi->RemoveView(static_cast<int>(random() % phi->GetMaps()->GetNumberOfBlocks())));
      }
      else
      {
        ASSERT_TRUE(phi->AddView(name, mapAt(view), static_cast<int>(view)));
      }
    }
  }
}

TEST(IncrementalContour, AfterAnAbortAndOtherSettings)
{
  const unsigned int seed = 2;
  vtkNew<vtkFreespaceUnion> phi;
  vtkNew<vtkBisectionContourFilter> contour;
  SetContour(phi, contour, seed);
  contour->IncrementalOn();
  phi->SetMaps(MakeMaps(seed, 6));
  contour->Update();
  ASSERT_TRUE(phi->RemoveView(4));
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  const unsigned long tag = contour->AddObserver(vtkCommand::ProgressEvent, stop);
  contour->Update();
  contour->RemoveObserver(tag);
  contour->SetAbortExecute(0); // VTK 9.3 leaves it
  contour->Modified();
  contour->Update();
  ExpectAsFromNothing(phi, contour->GetOutput(), seed);
  contour->SetTolerance(0.1);
  contour->SetExactCrossings(false);
  contour->Update();
  contour->SetTolerance(1e-3);
  contour->SetExactCrossings(true);
  ASSERT_TRUE(phi->RemoveView(0));
  contour->Update();
  ExpectAsFromNothing(phi, contour->GetOutput(), seed);
  contour->IncrementalOff();
  contour->Update();
  contour->IncrementalOn();
  contour->Update();
  ExpectAsFromNothing(phi, contour->GetOutput(), seed);
}
