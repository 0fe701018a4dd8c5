// SPDX-License-Identifier: BSD-3-Clause
#include "Support/PlainSettings.h"
#include "vtkFreespaceUnion.h"

#include "Contour/BisectionContour.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/ContourFields.h"
#include "Support/ErrorObserver.h"
#include "Support/ProgressWatch.h"
#include "Support/RandomMapBlocks.h"
#include "vtkBisectionContourFilter.h"

#include <vtkCallbackCommand.h>
#include <vtkCell.h>
#include <vtkClipPolyData.h>
#include <vtkCommand.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockDataSetAlgorithm.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSampleFunction.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace freespace;

namespace
{

// The numbers of triangles with 0, 1, 2 and 3 corners in free space.
std::array<int, 4> CountTrianglesByFreeCorners(vtkPolyData* surface, vtkFreespaceUnion* phi)
{
  std::array<int, 4> count{};
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    int free = 0;
    for (int corner = 0; corner < 3; ++corner)
    {
      double p[3];
      surface->GetPoint(surface->GetCell(i)->GetPointId(corner), p);
      free += phi->EvaluateFunction(p) > 0;
    }
    ++count[free];
  }
  return count;
}

}

TEST(vtkFreespaceUnion, ServesSampleFunctionCutterAndClipper)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  double bounds[6];
  phi->GetBounds(bounds);

  vtkNew<vtkSampleFunction> sample;
  sample->SetImplicitFunction(phi);
  sample->SetSampleDimensions(12, 12, 12);
  sample->SetModelBounds(bounds);
  sample->ComputeNormalsOff();
  sample->Update();
  vtkDataArray* values = sample->GetOutput()->GetPointData()->GetScalars();
  const FreespaceUnion core(RandomMaps(3, 3), Plain(FreespaceUnionOptions()));
  int matter = 0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    const double value = phi->EvaluateFunction(sample->GetOutput()->GetPoint(i));
    EXPECT_EQ(values->GetTuple1(i), value);
    EXPECT_EQ(value, core.Value(Eigen::Vector3d(sample->GetOutput()->GetPoint(i))));
    matter += value < 0;
  }
  EXPECT_GT(matter, 50);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.8);
  sphere->SetThetaResolution(60);
  sphere->SetPhiResolution(60);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputConnection(sphere->GetOutputPort());
  clip->SetClipFunction(phi);
  clip->Update();
  const std::array<int, 4> triangles = CountTrianglesByFreeCorners(sphere->GetOutput(), phi);
  ASSERT_GT(triangles[1], 20);
  ASSERT_GT(triangles[2], 20);
  // What is left of a triangle with two free corners is a quadrilateral, cut in two.
  EXPECT_EQ(clip->GetOutput()->GetNumberOfCells(), triangles[3] + triangles[1] + 2 * triangles[2]);

  vtkNew<vtkCutter> cut;
  cut->SetInputConnection(sphere->GetOutputPort());
  cut->SetCutFunction(phi);
  cut->Update();
  EXPECT_EQ(cut->GetOutput()->GetNumberOfCells(), triangles[1] + triangles[2]) << "a line in each";
}

TEST(vtkFreespaceUnion, FollowsItsMaps)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 2);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(maps);
  phi->SetInputConnection(producer->GetOutputPort());
  double first[6], second[6];
  phi->GetBounds(first);
  EXPECT_LT(first[0], first[1]);
  vtkMTimeType time = phi->GetMTime();
  EXPECT_EQ(time, phi->GetMTime());
  maps->GetBlock(0)->Modified();
  maps->Modified();
  EXPECT_GT(phi->GetMTime(), time);

  phi->SetMaps(maps);
  time = phi->GetMTime();
  vtkPolyData::SafeDownCast(maps->GetBlock(1))->GetPoints()->SetPoint(0, 50, 0, 0);
  maps->GetBlock(1)->Modified();
  EXPECT_GT(phi->GetMTime(), time);
  phi->GetBounds(second);
  EXPECT_GE(second[1], 50) << "the moved point, and the margin of a hundredth of the diagonal";
  EXPECT_LT(second[1], 51);
  time = phi->GetMTime();
  phi->SetHullMargin(0.5);
  EXPECT_GT(phi->GetMTime(), time);
}

TEST(vtkFreespaceUnion, BatchesAgreeWithSingleQueries)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkPoints> first, last;
  vtkNew<vtkDoubleArray> radii, fractions;
  vtkNew<vtkUnsignedCharArray> points, spheres;
  for (int i = 0; i < 2000; ++i)
  {
    const Eigen::Vector3d a = 1.5 * Eigen::Vector3d::Random(), b = 1.5 * Eigen::Vector3d::Random();
    first->InsertNextPoint(a.data());
    last->InsertNextPoint(b.data());
    radii->InsertNextValue(0.1 * (i % 4));
  }
  ASSERT_TRUE(phi->ArePointsFree(first, points));
  ASSERT_TRUE(phi->FirstBlocked(first, last, fractions));
  ASSERT_TRUE(phi->AreSpheresFree(first, radii, spheres));
  ASSERT_EQ(fractions->GetNumberOfValues(), 2000);
  int count[3] = { 0, 0, 0 };
  for (int i = 0; i < 2000; ++i)
  {
    double a[3], b[3];
    first->GetPoint(i, a);
    last->GetPoint(i, b);
    ASSERT_EQ(points->GetValue(i), phi->IsPointFree(a));
    ASSERT_EQ(fractions->GetValue(i), phi->FirstBlocked(a, b));
    ASSERT_EQ(fractions->GetValue(i) > 1, phi->IsSegmentFree(a, b));
    ASSERT_EQ(spheres->GetValue(i), phi->IsSphereFree(a, radii->GetValue(i)));
    count[0] += points->GetValue(i);
    count[1] += fractions->GetValue(i) > 1;
    count[2] += spheres->GetValue(i);
  }
  for (int c : count)
  {
    EXPECT_GT(c, 100);
    EXPECT_LT(c, 1900);
  }
  const double far[6] = { 50, 51, 50, 51, 50, 51 }, all[6] = { -9, 9, -9, 9, -9, 9 };
  EXPECT_TRUE(phi->IsBoxFree(far));
  EXPECT_FALSE(phi->IsBoxFree(all));

  vtkNew<ErrorObserver> errors;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  first->InsertNextPoint(0, 0, 0);
  EXPECT_FALSE(phi->FirstBlocked(first, last, fractions));
  EXPECT_FALSE(phi->AreSpheresFree(first, radii, spheres));
  EXPECT_EQ(errors->Count, 2);
}

TEST(vtkFreespaceUnion, BuildingIsWatched)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 40));
  std::vector<double> seen;
  vtkNew<vtkCallbackCommand> see;
  see->SetClientData(&seen);
  see->SetCallback([](vtkObject*, unsigned long, void* list, void* fraction)
    { static_cast<std::vector<double>*>(list)->push_back(*static_cast<double*>(fraction)); });
  phi->AddObserver(vtkCommand::ProgressEvent, see);
  EXPECT_FALSE(phi->IsBuilt());
  phi->Update();
  EXPECT_TRUE(phi->IsBuilt());
  ASSERT_GE(seen.size(), 4u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
  seen.clear();
  phi->Update(); // nothing to do
  EXPECT_TRUE(seen.empty());
}

TEST(vtkFreespaceUnion, BuildingStopsAtOnce)
{
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 20);
  for (int at = 1; at <= 4; ++at)
  {
    vtkNew<vtkFreespaceUnion> phi;
    SetPlain(phi.Get());
    vtkNew<ErrorObserver> errors;
    phi->SetMaps(maps);
    phi->AddObserver(vtkCommand::ErrorEvent, errors);
    Stopper stopper(phi, phi, true, at);
    phi->Update();
    EXPECT_TRUE(stopper.HasStopped);
    EXPECT_EQ(stopper.After, 0);
    EXPECT_FALSE(phi->IsBuilt());
    EXPECT_EQ(errors->Count, 0);
    EXPECT_TRUE(phi->IsValid()); // built anew
    double x[3] = { 0, 0, 0 };
    EXPECT_LT(std::abs(phi->EvaluateFunction(x)), 10);
  }
}

TEST(vtkFreespaceUnion, ObserversMayAskWhileItIsBuilt)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(MakeMaps(3, 2));
  vtkNew<vtkCallbackCommand> ask;
  ask->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      double bounds[6];
      vtkFreespaceUnion::SafeDownCast(caller)->GetBounds(bounds);
      EXPECT_GT(bounds[0], bounds[1]); // there are none yet
    });
  phi->AddObserver(vtkCommand::ProgressEvent, ask);
  phi->Update();
  EXPECT_TRUE(phi->IsBuilt());
}

TEST(vtkFreespaceUnion, BatchesStopAtOnceAndLeaveNoResults)
{
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 20);
  vtkNew<vtkPoints> first, last;
  vtkNew<vtkDoubleArray> radii;
  for (int i = 0; i < 5000; ++i)
  {
    const Eigen::Vector3d a = 1.5 * Eigen::Vector3d::Random(), b = 1.5 * Eigen::Vector3d::Random();
    first->InsertNextPoint(a.data());
    last->InsertNextPoint(b.data());
    radii->InsertNextValue(0.1);
  }
  for (const bool inBuilding : { true, false })
  {
    for (int kind = 0; kind < 3; ++kind)
    {
      vtkNew<vtkFreespaceUnion> phi;
      SetPlain(phi.Get());
      phi->SetMaps(maps);
      vtkNew<vtkUnsignedCharArray> free;
      vtkNew<vtkDoubleArray> fractions;
      const auto ask = [&]
      {
        return kind == 0 ? phi->ArePointsFree(first, free)
          : kind == 1    ? phi->FirstBlocked(first, last, fractions)
                         : phi->AreSpheresFree(first, radii, free);
      };
      for (const int at : { 1, 3, 0 }) // which no event is
      {
        phi->Modified();
        Stopper stopper(phi, phi, inBuilding, at);
        const bool isDone = ask();
        phi->RemoveObservers(vtkCommand::ProgressEvent);
        EXPECT_EQ(stopper.HasStopped, at > 0);
        EXPECT_EQ(stopper.After, 0);
        EXPECT_EQ(isDone, at == 0);
        EXPECT_EQ(free->GetNumberOfValues() + fractions->GetNumberOfValues(), isDone ? 5000 : 0);
      }
    }
  }
}

// What feeds the function is stopped too, and asked again the next time.
TEST(vtkFreespaceUnion, PassesTheWishToStopOnToItsPipeline)
{
  class SlowSource : public vtkMultiBlockDataSetAlgorithm
  {
  public:
    static SlowSource* New() { return new SlowSource; }
    SlowSource() { this->SetNumberOfInputPorts(0); }
    int RequestData(
      vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
    {
      for (this->Steps = 0; this->Steps < 100 && !this->GetAbortExecute(); ++this->Steps)
      {
        this->UpdateProgress(this->Steps / 100.0);
      }
      if (!this->GetAbortExecute())
      {
        vtkMultiBlockDataSet::GetData(outputVector)->ShallowCopy(MakeMaps(3, 3));
      }
      return 1;
    }
    int Steps = 0;
  };
  vtkNew<SlowSource> source;
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(20);
  {
    ProgressWatch progress(contour, 0.06);
    contour->Update();
    EXPECT_GE(progress.Last, 0.06);
    EXPECT_TRUE(progress.IsMonotone);
  }
  EXPECT_GT(source->Steps, 10);
  EXPECT_LT(source->Steps, 60);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
  contour->SetAbortExecute(0); // VTK 9.3 leaves it
  contour->Modified();
  contour->Update();
  EXPECT_EQ(source->Steps, 100);
  const FreespaceUnion core(RandomMaps(3, 3), Plain(FreespaceUnionOptions()));
  const ContourMesh mesh = BisectionContour(core, core.Hull().Bounds(), Cells(20));
  EXPECT_EQ(
    contour->GetOutput()->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.size()));
}

TEST(vtkFreespaceUnion, TellsWhatIsWrong)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  vtkNew<ErrorObserver> errors;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  double x[3] = { 0, 0, 0 };
  EXPECT_LT(phi->EvaluateFunction(x), 0);
  EXPECT_EQ(errors->Count, 1);
  EXPECT_LT(phi->EvaluateFunction(x), 0);
  EXPECT_EQ(errors->Count, 1); // once, not for each point

  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 2);
  maps->GetBlock(1)->GetFieldData()->RemoveArray("CameraIntrinsics");
  phi->SetMaps(maps);
  EXPECT_FALSE(phi->IsValid());
  EXPECT_NE(errors->Last.find("map1"), std::string::npos) << errors->Last;
  phi->SetMaps(MakeMaps(3, 2));
  phi->SetMinimumViews(0);
  EXPECT_FALSE(phi->IsValid());
  phi->SetMinimumViews(1);
  EXPECT_TRUE(phi->IsValid());
}
