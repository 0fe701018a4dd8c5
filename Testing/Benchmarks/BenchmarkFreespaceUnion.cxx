// SPDX-License-Identifier: BSD-3-Clause

// What Phi and its contour cost on the ideal features of the blocks scene: point queries against
// Embree on the same triangulated views, the contour against vtkSampleFunction and
// vtkFlyingEdges3D over the same function and lattice, its growth with the lattice, its threads and
// its memory. Counters hold the ratios.
//
//   BenchmarkFreespaceUnion [--benchmark_filter=...]

#include "Data/ViewBlocks.h"
#include "Common/ParseNumber.h"
#include "Disparity/DelaunayDisparity.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/SharedData.h"
#include "Support/PlainSettings.h"
#include "vtkBisectionContourFilter.h"
#include "vtkDelaunayDisparityFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCommand.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSampleFunction.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <random>

#ifdef FREESPACE_HAS_EMBREE
#include <embree3/rtcore.h>
#endif

using namespace freespace;
using Eigen::Vector3d;

namespace
{

struct Scene
{
  std::vector<View> views;
  std::vector<DisparityMap> maps;
  vtkNew<vtkFreespaceUnion> phi;

  Scene() { SetPlain(this->phi.Get()); }
};

const Scene& Blocks()
{
  static Scene* scene = []
  {
    auto* made = new Scene;
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName(SharedData("blocks/truth/ideal.vtm").c_str());
    reader->Update();
    made->views = ViewsFromBlocks(vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput()));
    made->maps = TriangulateViews(made->views, {});
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (const DisparityMap& map : made->maps)
    {
      SetNamedBlock(blocks, blocks->GetNumberOfBlocks(), map.name, BlockFromMap(map));
    }
    made->phi->SetMaps(blocks);
    made->phi->Update();
    return made;
  }();
  return *scene;
}

std::vector<Vector3d> RandomPoints(std::size_t count)
{
  const Eigen::AlignedBox3d& box = Blocks().phi->GetCore()->Hull().Bounds();
  std::mt19937 random(1);
  std::vector<Vector3d> points(count);
  for (Vector3d& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = std::uniform_real_distribution<double>(box.min()[axis], box.max()[axis])(random);
    }
  }
  return points;
}

double Seconds(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// The high-water mark of memory during some work, above what was in use before, in MB.
double PeakMegabytes(const std::function<void()>& work)
{
  const auto status = [](const std::string& key)
  {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
    {
      if (word == key + ":")
      {
        file >> word;
        return ParseNumber<double>(word).value() / 1024;
      }
    }
    return 0.0;
  };
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  const double before = status("VmRSS");
  work();
  return status("VmHWM") - before;
}

void Contour(int cells)
{
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(Blocks().phi);
  contour->SetCells(cells);
  contour->Update();
}

// The same lattice as the contour's, sampled point by point.
void SampleAndFlyingEdges(int cells)
{
  double b[6];
  Blocks().phi->GetBounds(b);
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, b[2 * axis + 1] - b[2 * axis]);
  }
  const double spacing = longest / (cells - 1);
  int dimensions[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = static_cast<int>(std::ceil((b[2 * axis + 1] - b[2 * axis]) / spacing - 1e-9)) + 1;
    const double center = 0.5 * (b[2 * axis] + b[2 * axis + 1]);
    b[2 * axis] = center - 0.5 * spacing * n;
    b[2 * axis + 1] = center + 0.5 * spacing * n;
    dimensions[axis] = n + 1;
  }
  vtkNew<vtkSampleFunction> sample;
  sample->SetImplicitFunction(Blocks().phi);
  sample->SetModelBounds(b);
  sample->SetSampleDimensions(dimensions);
  sample->ComputeNormalsOff();
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputConnection(sample->GetOutputPort());
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeScalarsOff();
  edges->Update();
}

#ifdef FREESPACE_HAS_EMBREE
// Each view's triangles as a scene: a point is in front of them when a ray from the camera towards
// the point meets them beyond it.
class EmbreeViews
{
public:
  explicit EmbreeViews(const std::vector<DisparityMap>& maps)
    : Device(rtcNewDevice(nullptr))
  {
    for (const DisparityMap& map : maps)
    {
      RTCScene scene = rtcNewScene(this->Device);
      RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
        0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), map.points.size()));
      for (std::size_t i = 0; i < map.points.size(); ++i)
      {
        Eigen::Map<Eigen::Vector3f>(vertices + 3 * i) = map.points[i].cast<float>();
      }
      auto* corners = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry,
        RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(int), map.triangles.size()));
      std::copy_n(&map.triangles[0][0], 3 * map.triangles.size(), corners);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
      rtcCommitScene(scene);
      this->Scenes.push_back(scene);
      this->Eyes.push_back(map.camera.Center().cast<float>());
    }
  }

  bool IsFree(const Vector3d& point) const
  {
    for (std::size_t i = 0; i < this->Scenes.size(); ++i)
    {
      const Eigen::Vector3f direction = point.cast<float>() - this->Eyes[i];
      RTCRayHit ray;
      ray.ray = { this->Eyes[i].x(), this->Eyes[i].y(), this->Eyes[i].z(), 0.0f, direction.x(),
        direction.y(), direction.z(), 0.0f, HUGE_VALF, 0xffffffffu, 0, 0 };
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(this->Scenes[i], &context, &ray);
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID && ray.ray.tfar > 1.0f)
      {
        return true;
      }
    }
    return false;
  }

private:
  RTCDevice Device;
  std::vector<RTCScene> Scenes;
  std::vector<Eigen::Vector3f> Eyes;
};

// Both decide from the views alone whether random points are free.
void PointQueriesAgainstEmbree(benchmark::State& state)
{
  const auto core = Blocks().phi->GetCore();
  const EmbreeViews embree(Blocks().maps);
  const std::vector<Vector3d> points = RandomPoints(1000000);
  double own = 0, theirs = 0;
  std::size_t different = 0;
  for (auto _ : state)
  {
    std::vector<char> a(points.size()), b(points.size());
    own += Seconds(
      [&]
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          a[i] = core->IsSeenFree(points[i]);
        }
      });
    theirs += Seconds(
      [&]
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          b[i] = embree.IsFree(points[i]);
        }
      });
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      different += a[i] != b[i];
    }
  }
  const double queries = static_cast<double>(state.iterations()) * points.size();
  state.counters["own_ns"] = 1e9 * own / queries;
  state.counters["embree_ns"] = 1e9 * theirs / queries;
  state.counters["times_faster"] = theirs / own;
  state.counters["different"] = different / queries;
}
BENCHMARK(PointQueriesAgainstEmbree)->Iterations(3)->Unit(benchmark::kMillisecond);
#endif

void PointQueries(benchmark::State& state)
{
  const auto core = Blocks().phi->GetCore();
  const std::vector<Vector3d> points = RandomPoints(1000000);
  double sign = 0, value = 0;
  for (auto _ : state)
  {
    sign += Seconds(
      [&]
      {
        for (const Vector3d& p : points)
        {
          benchmark::DoNotOptimize(core->IsFree(p));
        }
      });
    value += Seconds(
      [&]
      {
        for (const Vector3d& p : points)
        {
          benchmark::DoNotOptimize(core->Value(p));
        }
      });
  }
  const double queries = static_cast<double>(state.iterations()) * points.size();
  state.counters["planes"] = core->Hull().NumberOfPlanes();
  state.counters["sign_ns"] = 1e9 * sign / queries;
  state.counters["value_ns"] = 1e9 * value / queries;
}
BENCHMARK(PointQueries)->Iterations(3)->Unit(benchmark::kMillisecond);

void ContourAgainstFlyingEdges(benchmark::State& state)
{
  const int cells = static_cast<int>(state.range(0));
  Blocks();
  double own = 0, theirs = 0, ownPeak = 0, theirPeak = 0;
  for (auto _ : state)
  {
    ownPeak = PeakMegabytes([&] { own += Seconds([&] { Contour(cells); }); });
    theirPeak = PeakMegabytes([&] { theirs += Seconds([&] { SampleAndFlyingEdges(cells); }); });
  }
  state.counters["own_s"] = own / state.iterations();
  state.counters["vtk_s"] = theirs / state.iterations();
  state.counters["times_faster"] = theirs / own;
  state.counters["own_MB"] = ownPeak;
  state.counters["vtk_MB"] = theirPeak;
  state.counters["memory_ratio"] = theirPeak / ownPeak;
}
BENCHMARK(ContourAgainstFlyingEdges)->Arg(256)->Arg(512)->Iterations(1)->Unit(benchmark::kSecond);

void ContourGrowth(benchmark::State& state)
{
  const int cells = static_cast<int>(state.range(0));
  Blocks();
  double coarse = 0, fine = 0;
  for (auto _ : state)
  {
    coarse += Seconds([&] { Contour(cells / 2); });
    fine += Seconds([&] { Contour(cells); });
  }
  state.counters["s"] = fine / state.iterations();
  state.counters["growth"] = fine / coarse;
}
BENCHMARK(ContourGrowth)
  ->RangeMultiplier(2)
  ->Range(512, 2048)
  ->Iterations(1)
  ->Unit(benchmark::kSecond);

// From the wish to stop to the empty output, at several places on the way.
void ContourAbort(benchmark::State& state)
{
  Blocks();
  double longest = 0;
  for (auto _ : state)
  {
    for (double when = 0.02; when < 1; when += 0.08)
    {
      vtkNew<vtkBisectionContourFilter> contour;
      SetPlainContour(contour.Get());
      contour->SetImplicitFunction(Blocks().phi);
      contour->SetCells(1024);
      std::chrono::steady_clock::time_point asked;
      struct Stopper : vtkCommand
      {
        double when;
        std::chrono::steady_clock::time_point* asked;
        void Execute(vtkObject* caller, unsigned long, void* fraction) override
        {
          auto* algorithm = static_cast<vtkAlgorithm*>(caller);
          if (*static_cast<double*>(fraction) >= this->when && !algorithm->GetAbortExecute())
          {
            *this->asked = std::chrono::steady_clock::now();
            algorithm->SetAbortExecute(1);
          }
        }
      };
      auto stopper = vtkSmartPointer<Stopper>::Take(new Stopper);
      stopper->when = when;
      stopper->asked = &asked;
      contour->AddObserver(vtkCommand::ProgressEvent, stopper);
      contour->Update();
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - asked;
      longest = std::max(longest, taken.count());
    }
  }
  state.counters["longest_ms"] = 1e3 * longest;
}
BENCHMARK(ContourAbort)->Iterations(1)->Unit(benchmark::kSecond);

void ContourThreads(benchmark::State& state)
{
  Blocks();
  double one = 0, two = 0;
  for (auto _ : state)
  {
    vtkSMPTools::Initialize(1);
    one += Seconds([] { Contour(512); });
    vtkSMPTools::Initialize(2);
    two += Seconds([] { Contour(512); });
  }
  vtkSMPTools::Initialize(0);
  state.counters["one_s"] = one / state.iterations();
  state.counters["two_s"] = two / state.iterations();
  state.counters["speedup"] = one / two;
}
BENCHMARK(ContourThreads)->Iterations(3)->Unit(benchmark::kSecond);

// Features to mesh with the settings of the program: what COLMAP's mesher took 44 s for.
void FeaturesToMesh(benchmark::State& state)
{
  double read = 0, triangulate = 0, contour = 0;
  for (auto _ : state)
  {
    vtkNew<vtkXMLMultiBlockDataReader> features;
    features->SetFileName(SharedData("blocks/truth/ideal.vtm").c_str());
    read += Seconds([&] { features->Update(); });
    vtkNew<vtkDelaunayDisparityFilter> maps;
    maps->SetInputConnection(features->GetOutputPort());
    triangulate += Seconds([&] { maps->Update(); });
    vtkNew<vtkFreespaceUnion> phi;
    SetPlain(phi.Get());
    phi->SetMaps(maps->GetOutput());
    vtkNew<vtkBisectionContourFilter> surface;
    SetPlainContour(surface.Get());
    surface->SetImplicitFunction(phi);
    surface->SharpEdgesOn();
    contour += Seconds([&] { surface->Update(); });
  }
  state.counters["read_s"] = read / state.iterations();
  state.counters["triangulate_s"] = triangulate / state.iterations();
  state.counters["contour_s"] = contour / state.iterations();
  state.counters["all_s"] = (read + triangulate + contour) / state.iterations();
}
BENCHMARK(FeaturesToMesh)->Iterations(3)->Unit(benchmark::kSecond);

}

int main(int argc, char** argv)
{
  if (SharedData("blocks/truth/ideal.vtm").empty())
  {
    std::cerr
      << "The benchmark needs the scene 'blocks' in the folder that FREESPACE_SHARED names.\n";
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
