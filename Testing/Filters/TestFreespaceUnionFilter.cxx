// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"
#include "vtkAppendPiecesFilter.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFreespaceUnion.h"
#include "vtkSimplifySurfaceFilter.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkCommand.h>
#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockDataSetAlgorithm.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSampleFunction.h>
#include <vtkSphere.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <vector>

using namespace freespace;

namespace
{

vtkSmartPointer<vtkMultiBlockDataSet> MakeMaps(unsigned int seed, int count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const DisparityMap& map : RandomMaps(seed, count))
  {
    SetNamedBlock(blocks, blocks->GetNumberOfBlocks(), map.name, BlockFromMap(map));
  }
  return blocks;
}

// Watches an algorithm's progress, and stops it when that has come to a value.
class ProgressWatch
{
public:
  ProgressWatch(vtkAlgorithm* algorithm, double stopAt)
    : Algorithm(algorithm)
    , StopAt(stopAt)
  {
    this->Tag = algorithm->AddObserver(vtkCommand::ProgressEvent, this, &ProgressWatch::See);
  }
  ~ProgressWatch() { this->Algorithm->RemoveObserver(this->Tag); }

  double Last = 0, Greatest = 0;
  int Steps = 0, After = 0;
  bool IsMonotone = true;
  std::function<void()> AtStop;

private:
  void See(vtkObject*, unsigned long, void* data)
  {
    const double value = *static_cast<double*>(data);
    this->IsMonotone = this->IsMonotone && value >= this->Last;
    this->Greatest = std::max(this->Greatest, value - this->Last);
    this->Steps += value > this->Last;
    this->After += this->Algorithm->GetAbortExecute() != 0 && value < 1;
    this->Last = value;
    if (value >= this->StopAt)
    {
      this->Algorithm->SetAbortExecute(1);
      if (this->AtStop)
      {
        this->AtStop();
      }
    }
  }

  vtkAlgorithm* Algorithm;
  double StopAt;
  unsigned long Tag;
};

// Counts errors and keeps them off the terminal.
class Errors : public vtkCommand
{
public:
  static Errors* New() { return new Errors; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    ++this->Count;
    this->Last = static_cast<const char*>(text);
  }
  int Count = 0;
  std::string Last;
};

}

TEST(vtkFreespaceUnion, ServesSampleFunctionCutterAndClipper)
{
  vtkNew<vtkFreespaceUnion> phi;
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
  int matter = 0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    const double value = phi->EvaluateFunction(sample->GetOutput()->GetPoint(i));
    EXPECT_EQ(values->GetTuple1(i), value);
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
  ASSERT_GT(clip->GetOutput()->GetNumberOfCells(), 10);
  ASSERT_LT(clip->GetOutput()->GetNumberOfCells(), sphere->GetOutput()->GetNumberOfCells());

  vtkNew<vtkCutter> cut;
  cut->SetInputConnection(sphere->GetOutputPort());
  cut->SetCutFunction(phi);
  cut->Update();
  EXPECT_GT(cut->GetOutput()->GetNumberOfCells(), 10);
}

TEST(vtkFreespaceUnion, FollowsItsMaps)
{
  vtkNew<vtkFreespaceUnion> phi;
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
  EXPECT_GT(second[1], 49);
  time = phi->GetMTime();
  phi->SetHullMargin(0.5);
  EXPECT_GT(phi->GetMTime(), time);
}

TEST(vtkFreespaceUnion, BatchesAgreeWithSingleQueries)
{
  vtkNew<vtkFreespaceUnion> phi;
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

  vtkNew<Errors> errors;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  first->InsertNextPoint(0, 0, 0);
  EXPECT_FALSE(phi->FirstBlocked(first, last, fractions));
  EXPECT_FALSE(phi->AreSpheresFree(first, radii, spheres));
  EXPECT_EQ(errors->Count, 2);
}

namespace
{

// Stops a function's building, or what is done after it, at the n-th progress event there.
class Stopper
{
public:
  Stopper(vtkObject* worker, vtkFreespaceUnion* phi, bool inBuilding, int at)
    : Phi(phi)
    , IsInBuilding(inBuilding)
    , Left(at)
  {
    worker->AddObserver(vtkCommand::ProgressEvent, this, &Stopper::See);
  }

  bool HasStopped = false;
  int After = 0;

private:
  void See(vtkObject* caller, unsigned long, void*)
  {
    this->After += this->HasStopped;
    if (this->Phi->IsBuilt() != this->IsInBuilding && this->Left-- == 1)
    {
      this->HasStopped = true;
      auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
      algorithm ? algorithm->SetAbortExecute(1) : this->Phi->SetAbortExecute(1);
    }
  }

  vtkFreespaceUnion* Phi;
  bool IsInBuilding;
  int Left;
};

}

TEST(vtkFreespaceUnion, BuildingIsWatched)
{
  vtkNew<vtkFreespaceUnion> phi;
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
    vtkNew<Errors> errors;
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
  phi->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkBisectionContourFilter> contour;
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
  contour->Modified();
  contour->Update();
  EXPECT_EQ(source->Steps, 100);
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 100);
}

TEST(vtkFreespaceUnion, TellsWhatIsWrong)
{
  vtkNew<vtkFreespaceUnion> phi;
  vtkNew<Errors> errors;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  double x[3] = { 0, 0, 0 };
  EXPECT_GT(phi->EvaluateFunction(x), 0);
  EXPECT_EQ(errors->Count, 1);
  EXPECT_GT(phi->EvaluateFunction(x), 0);
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

TEST(vtkBisectionContourFilter, ContoursAUnion)
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  contour->SetCells(40);
  contour->Update();
  vtkPolyData* output = contour->GetOutput();
  ASSERT_GT(output->GetNumberOfCells(), 1000);
  ASSERT_TRUE(output->GetCellData()->GetArray("View"));
  ASSERT_TRUE(output->GetCellData()->GetArray("Kind"));
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
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
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
  class CountingSphere : public vtkSphere
  {
  public:
    static CountingSphere* New() { return new CountingSphere; }
    using vtkSphere::EvaluateFunction;
    double EvaluateFunction(double x[3]) override
    {
      ++this->Calls;
      return this->vtkSphere::EvaluateFunction(x);
    }
    int Calls = 0;
  };
  vtkNew<CountingSphere> sphere;
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(sphere);
  contour->SetBounds(-1, 1, -1, 1, -1, 1);
  contour->SetCells(100);
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 1000);
  const int all = sphere->Calls;

  for (const double when : { 0.01, 0.4 })
  {
    ProgressWatch progress(contour, when);
    int before = 0;
    progress.AtStop = [&] { before = sphere->Calls; };
    sphere->Calls = 0;
    contour->Modified();
    contour->Update();
    EXPECT_GE(progress.Last, when);
    EXPECT_LT(before, all);
    EXPECT_EQ(sphere->Calls, before);
    EXPECT_EQ(progress.After, 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
    contour->SetAbortExecute(0);
  }
}

TEST(vtkBisectionContourFilter, ProgressesSmoothly)
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
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
  for (int at = 1; at <= 4; ++at)
  {
    vtkNew<vtkFreespaceUnion> phi;
    phi->SetMaps(maps);
    vtkNew<vtkBisectionContourFilter> contour;
    contour->SetImplicitFunction(phi);
    contour->SetCells(20);
    vtkNew<Errors> errors;
    contour->AddObserver(vtkCommand::ErrorEvent, errors);
    {
      Stopper stopper(contour, phi, true, at);
      contour->EstimateMemory();
      EXPECT_TRUE(stopper.HasStopped);
      EXPECT_FALSE(phi->IsBuilt());
      contour->RemoveObservers(vtkCommand::ProgressEvent);
    }
    Stopper stopper(contour, phi, true, at + 1); // the first is the pipeline's own
    contour->Update();
    EXPECT_TRUE(stopper.HasStopped);
    EXPECT_EQ(stopper.After, 0);
    EXPECT_FALSE(phi->IsBuilt());
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(errors->Count, 0);
    contour->Modified();
    contour->Update();
    EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 100);
  }
}

TEST(vtkAppendPiecesFilter, PiecesTogetherAreTheWhole)
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
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
  vtkNew<Errors> errors;
  append->AddObserver(vtkCommand::ErrorEvent, errors);
  append->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  append->Update();
  EXPECT_GE(errors->Count, 1);
  EXPECT_EQ(append->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(vtkBisectionContourFilter, ContoursAnyFunction)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(2);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(sphere);
  contour->SetBounds(-3, 3, -3, 3, -3, 3);
  contour->SetCells(30);
  contour->Update();
  ASSERT_GT(contour->GetOutput()->GetNumberOfPoints(), 500);
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
  phi->SetMaps(MakeMaps(3, 3));
  double b[6];
  phi->GetBounds(b);
  vtkNew<vtkTransform> transform;
  transform->Translate(-5, 0, 0); // maps the world to the function
  phi->SetTransform(transform);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  contour->SetCells(30);
  contour->SetBounds(b[0] + 5, b[1] + 5, b[2], b[3], b[4], b[5]);
  contour->Update();
  ASSERT_GT(contour->GetOutput()->GetNumberOfCells(), 500);
  EXPECT_NEAR(contour->GetOutput()->GetBounds()[0], b[0] + 5, 0.02 * (b[1] - b[0]));
}

TEST(vtkBisectionContourFilter, TellsWhatIsWrong)
{
  vtkNew<vtkBisectionContourFilter> contour;
  vtkNew<Errors> errors;
  contour->AddObserver(vtkCommand::ErrorEvent, errors);
  contour->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  contour->Update();
  EXPECT_GE(errors->Count, 1);
  vtkNew<vtkSphere> sphere;
  contour->SetImplicitFunction(sphere);
  errors->Count = 0;
  contour->Update(); // no bounds
  EXPECT_GE(errors->Count, 1);
  contour->SetBounds(-1, 1, -1, 1, -1, 1);
  contour->SetCells(0);
  errors->Count = 0;
  contour->Update();
  EXPECT_GE(errors->Count, 1);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}

TEST(vtkBisectionContourFilter, RefusesFeaturesWithoutTriangles)
{
  const vtkSmartPointer<vtkMultiBlockDataSet> maps = MakeMaps(3, 2);
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  contour->SetCells(20);
  vtkNew<Errors> errors;
  contour->AddObserver(vtkCommand::ErrorEvent, errors);
  contour->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
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
  phi->SetMaps(MakeMaps(3, 2));
  phi->SetMinimumViews(3);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  vtkNew<Errors> errors, ignored;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  contour->AddObserver(vtkCommand::ErrorEvent, ignored);
  contour->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ignored);
  contour->Update();
  EXPECT_NE(errors->Last.find("only 2 views"), std::string::npos) << errors->Last;
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}

TEST(vtkSimplifySurfaceFilter, LeavesOutTrianglesAndKeepsLabels)
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(MakeMaps(3, 3));
  vtkNew<vtkBisectionContourFilter> contour;
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
  vtkObject::GlobalWarningDisplayOff();
  simplify->SetDistance(0);
  EXPECT_FALSE(simplify->GetExecutive()->Update());
  EXPECT_EQ(simplify->GetOutput()->GetNumberOfCells(), 0);
  vtkObject::GlobalWarningDisplayOn();
}
