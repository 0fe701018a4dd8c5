// SPDX-License-Identifier: BSD-3-Clause
#include "Support/PlainSettings.h"
#include "vtkBisectionContourFilter.h"

#include "Contour/BisectionContour.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/ContourFields.h"
#include "Support/ErrorObserver.h"
#include "Support/ProgressWatch.h"
#include "Support/RandomMapBlocks.h"
#include "vtkFreespaceUnion.h"
#include "Support/Filters/WatchedSphere.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphere.h>
#include <vtkTransform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace freespace;

namespace
{

// A closed surface of triangles without handles: Euler's formula.
void ExpectSphere(vtkPolyData* surface)
{
  ASSERT_GT(surface->GetNumberOfPoints(), 0);
  EXPECT_EQ(surface->GetNumberOfPolys(), 2 * surface->GetNumberOfPoints() - 4);
}

}

TEST(vtkBisectionContourFilter, NormalsPointIntoFreeSpace)
{
  vtkNew<vtkSphere> ball;
  ball->SetRadius(0.4);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(ball);
  contour->SetBounds(-0.5, 0.5, -0.5, 0.5, -0.5, 0.5);
  contour->SetCells(24);
  contour->SharpEdgesOff();
  contour->Update();
  EXPECT_EQ(contour->GetOutput()->GetPointData()->GetNormals(), nullptr) << "only if asked for";
  contour->ComputeNormalsOn();
  contour->Update();
  vtkDataArray* normals = contour->GetOutput()->GetPointData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  ASSERT_EQ(normals->GetNumberOfTuples(), contour->GetOutput()->GetNumberOfPoints());
  EXPECT_STREQ(normals->GetName(), "Normals");
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const Eigen::Vector3d point(contour->GetOutput()->GetPoint(i)), normal(normals->GetTuple3(i));
    ASSERT_NEAR(normal.norm(), 1, 1e-5);
    ASSERT_GT(normal.dot(point.normalized()), std::cos(6 * M_PI / 180));
  }
}

TEST(vtkBisectionContourFilter, ContoursAUnion)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(40);
  contour->Update();
  vtkPolyData* output = contour->GetOutput();
  // The core's mesh of the same maps, point by point.
  const FreespaceUnion core(RandomMaps(3, 3), Plain(FreespaceUnionOptions()));
  const ContourMesh mesh = BisectionContour(core, core.Hull().Bounds(), Cells(40));
  ASSERT_EQ(output->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.points.size()));
  ASSERT_EQ(output->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Eigen::Vector3d point(output->GetPoint(static_cast<vtkIdType>(i)));
    EXPECT_LT((point - mesh.points[i]).norm(), 1e-6);
  }
  vtkDataArray* views = output->GetCellData()->GetArray("View");
  vtkDataArray* kinds = output->GetCellData()->GetArray("Kind");
  ASSERT_TRUE(views && kinds);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    EXPECT_EQ(views->GetTuple1(static_cast<vtkIdType>(t)), mesh.view[t]);
    EXPECT_EQ(kinds->GetTuple1(static_cast<vtkIdType>(t)), static_cast<int>(mesh.kind[t]));
  }
  // The sign changes around the vertices, but for some at sharp edges.
  double bounds[6];
  phi->GetBounds(bounds);
  const double step = 0.01 * (bounds[1] - bounds[0]);
  int tried = 0, mixed = 0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); i += 7)
  {
    int free = 0;
    for (int j = 0; j < 6; ++j)
    {
      double p[3];
      output->GetPoint(i, p);
      p[j / 2] += j % 2 ? step : -step;
      free += phi->EvaluateFunction(p) > 0;
    }
    ++tried;
    mixed += free > 0 && free < 6;
  }
  EXPECT_GT(mixed, 0.95 * tried);
  const vtkIdType before = output->GetNumberOfCells();
  contour->SetCells(60);
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 1.8 * before);
  phi->SetHullMargin(0.2);
  contour->Update();
  double b[6];
  phi->GetBounds(b);
  EXPECT_NEAR(contour->GetOutput()->GetBounds()[0], b[0], 0.02 * (b[1] - b[0]));
}

TEST(vtkBisectionContourFilter, KeepsWhatWasSeen)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(40);
  contour->Update();
  vtkDataArray* kinds = contour->GetOutput()->GetCellData()->GetArray("Kind");
  vtkDataArray* supported = contour->GetOutput()->GetCellData()->GetArray("Supported");
  vtkIdType seen = 0, ofFeatures = 0;
  for (vtkIdType i = 0; i < kinds->GetNumberOfTuples(); ++i)
  {
    seen += kinds->GetTuple1(i) == 0 || supported->GetTuple1(i) == 1;
    ofFeatures += kinds->GetTuple1(i) == 0;
  }
  EXPECT_GT(ofFeatures, 100);
  EXPECT_GT(seen, ofFeatures);
  EXPECT_LT(seen, kinds->GetNumberOfTuples());
  contour->ObservedOnlyOn();
  contour->Update();
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), seen);
  contour->SharpEdgesOn();
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), seen);
}

TEST(vtkBisectionContourFilter, StopsAtOnce)
{
  int calls = 0;
  vtkNew<WatchedSphere> sphere;
  sphere->OnEvaluation = [&calls] { ++calls; };
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(sphere);
  contour->SetBounds(-1, 1, -1, 1, -1, 1);
  contour->SetCells(100);
  contour->Update();
  ExpectSphere(contour->GetOutput());
  const int all = calls;

  for (const double when : { 0.01, 0.4 })
  {
    ProgressWatch progress(contour, when);
    int before = 0;
    progress.AtStop = [&] { before = calls; };
    calls = 0;
    contour->Modified();
    contour->Update();
    EXPECT_GE(progress.Last, when);
    EXPECT_LT(before, all);
    EXPECT_EQ(calls, before);
    EXPECT_EQ(progress.After, 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
    contour->SetAbortExecute(0);
  }
}

TEST(vtkBisectionContourFilter, ProgressesSmoothly)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(300);
  contour->SharpEdgesOn();
  ProgressWatch progress(contour, 2.0);
  contour->Update();
  EXPECT_GT(progress.Steps, 30);
  EXPECT_TRUE(progress.IsMonotone);
  EXPECT_LT(progress.Greatest, 0.1);
  EXPECT_EQ(progress.Last, 1.0);
}

TEST(vtkBisectionContourFilter, StopsWhileTheUnionIsBuilt)
{
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 20);
  const FreespaceUnion core(RandomMaps(3, 20), Plain(FreespaceUnionOptions()));
  const auto whole = static_cast<vtkIdType>(
    BisectionContour(core, core.Hull().Bounds(), Cells(20)).triangles.size());
  for (int at = 1; at <= 4; ++at)
  {
    vtkNew<vtkFreespaceUnion> phi;
    SetPlain(phi.Get());
    phi->SetMaps(maps);
    vtkNew<vtkBisectionContourFilter> contour;
    SetPlainContour(contour.Get());
    contour->SetImplicitFunction(phi);
    contour->SetCells(20);
    vtkNew<ErrorObserver> errors;
    contour->AddObserver(vtkCommand::ErrorEvent, errors);
    {
      Stopper stopper(contour, phi, true, at);
      contour->EstimateMemory();
      EXPECT_TRUE(stopper.HasStopped);
      EXPECT_FALSE(phi->IsBuilt());
      contour->RemoveObservers(vtkCommand::ProgressEvent);
      contour->SetAbortExecute(0); // VTK 9.3 leaves it
    }
    Stopper stopper(contour, phi, true, at + 1); // the first is the pipeline's own
    contour->Update();
    EXPECT_TRUE(stopper.HasStopped);
    EXPECT_EQ(stopper.After, 0);
    EXPECT_FALSE(phi->IsBuilt());
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(errors->Count, 0);
    contour->SetAbortExecute(0);
    contour->Modified();
    contour->Update();
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), whole) << "as if it had not been stopped";
  }
}

TEST(vtkBisectionContourFilter, ContoursAnyFunction)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(2);
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(sphere);
  contour->SetBounds(-3, 3, -3, 3, -3, 3);
  contour->SetCells(30);
  contour->Update();
  ExpectSphere(contour->GetOutput());
  for (vtkIdType i = 0; i < contour->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double p[3];
    contour->GetOutput()->GetPoint(i, p);
    EXPECT_NEAR(vtkMath::Norm(p), 2.0, 0.003);
  }
  EXPECT_FALSE(contour->GetOutput()->GetCellData()->GetArray("View"));
  sphere->SetRadius(1);
  contour->Update();
  EXPECT_NEAR(contour->GetOutput()->GetBounds()[1], 1.0, 0.01);
}

TEST(vtkBisectionContourFilter, ATransformedUnionMovesItsSurface)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  double b[6];
  phi->GetBounds(b);
  vtkNew<vtkTransform> transform;
  transform->Translate(-5, 0, 0); // maps the world to the function
  phi->SetTransform(transform);
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(30);
  contour->SetBounds(b[0] + 5, b[1] + 5, b[2], b[3], b[4], b[5]);
  contour->Update();
  vtkPolyData* moved = contour->GetOutput();
  // The mesh of the union itself, but for points of the lattice that round to the other side.
  const FreespaceUnion core(RandomMaps(3, 3), Plain(FreespaceUnionOptions()));
  const ContourMesh mesh = BisectionContour(core, core.Hull().Bounds(), Cells(30));
  const double triangles = static_cast<double>(mesh.triangles.size());
  EXPECT_NEAR(static_cast<double>(moved->GetNumberOfCells()) / triangles, 1, 0.02);
  double low = HUGE_VAL;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    low = std::min(low, point.x());
  }
  EXPECT_NEAR(moved->GetBounds()[0], low + 5, 0.002 * (b[1] - b[0]));
}

TEST(vtkBisectionContourFilter, TellsWhatIsWrong)
{
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  vtkNew<ErrorObserver> errors;
  errors->Observe(contour);
  contour->Update();
  EXPECT_TRUE(errors->Has("There is no implicit function to contour.")) << errors->All;
  vtkNew<vtkSphere> sphere;
  contour->SetImplicitFunction(sphere);
  errors->All.clear();
  contour->Update(); // no bounds
  EXPECT_TRUE(errors->Has("The function does not tell its bounds")) << errors->All;
  contour->SetBounds(-1, 1, -1, 1, -1, 1);
  contour->SetCells(0);
  errors->All.clear();
  contour->Update();
  EXPECT_TRUE(errors->Has("it must have at least 2")) << errors->All;
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}

TEST(vtkBisectionContourFilter, RefusesFeaturesWithoutTriangles)
{
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 2);
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(maps);
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(20);
  vtkNew<ErrorObserver> errors;
  errors->Observe(contour);
  for (unsigned int i = 0; i < 2; ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(maps->GetBlock(i));
    view->SetPolys(nullptr);
    view->Modified();
    errors->Last.clear();
    contour->Update();
    // One view without triangles is fine, all are not.
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells() > 0, i == 0);
    EXPECT_EQ(errors->Last.empty(), i == 0) << errors->Last;
  }
}

TEST(vtkBisectionContourFilter, RefusesMoreViewsThanThereAre)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 2));
  phi->SetMinimumViews(3);
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  vtkNew<ErrorObserver> errors, ignored;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  ignored->Observe(contour);
  contour->Update();
  EXPECT_NE(errors->Last.find("only 2 views"), std::string::npos) << errors->Last;
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}
