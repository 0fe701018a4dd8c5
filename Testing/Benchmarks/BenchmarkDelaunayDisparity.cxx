// SPDX-License-Identifier: BSD-3-Clause

// What the minimum disparity constraint costs: the disparity map of a view over one CGAL Delaunay
// triangulation of the points that the map has in the end, and how both grow with their number. How the maps of
// all views of a ring, with the constraint and the background, grow with the number of views.
//
//   BenchmarkDelaunayDisparity [--benchmark_filter=...]

#include "Disparity/Background/BackgroundContinuation.h"
#include "Disparity/DelaunayDisparity.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>

using namespace freespace;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Seconds, per kind of scene and number of points.
std::map<std::string, std::map<int, double>> Times;

View MakeView()
{
  View view;
  view.camera.K << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  view.camera.width = view.camera.height = 1000;
  return view;
}

// A dome in disparity: any chord lies below it.
double Dome(const Eigen::Vector2d& pixel)
{
  return 1 - 0.4 * (pixel / 500 - Eigen::Vector2d(1, 1)).squaredNorm();
}

// One view with features on the dome, of which another view knows more; these stick out, because
// they are lifted, or because the dome does out of what the view's few points span.
std::vector<View> DomeViews(int own, int others, double lift)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> pixel(0, 1000), height(0.5 * lift, lift);
  std::vector<View> views(2, MakeView());
  for (int i = 0; i < own + others; ++i)
  {
    Eigen::Vector2d at(pixel(random), pixel(random));
    if (i < 4) // the corners, so that all others are inside
    {
      at = { i % 2 ? 1000 : 0, i / 2 ? 1000 : 0 };
    }
    View& view = views[i < own ? 0 : 1];
    const double disparity = Dome(at) * (i < own ? 1 : 1 + height(random));
    view.points.push_back(view.camera.Unproject(at, 1 / disparity));
    view.imagePoints.push_back(at);
  }
  return views;
}

double Seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Measure(benchmark::State& state, const std::string& scene, const std::vector<View>& views)
{
  DelaunayDisparityOptions options;
  options.tolerance = 1e-9;
  options.spatialFlips = false;
  double mapTime = 0, delaunayTime = 0;
  std::size_t inserted = 0;
  for (auto _ : state)
  {
    const double begin = Seconds();
    const DisparityMap map = TriangulateView(views, 0, options);
    const double middle = Seconds();
    std::vector<Kernel::Point_2> points;
    for (const Eigen::Vector2d& pixel : map.imagePoints)
    {
      points.emplace_back(pixel.x(), pixel.y());
    }
    const double before = Seconds();
    const CGAL::Delaunay_triangulation_2<Kernel> delaunay(points.begin(), points.end());
    delaunayTime += Seconds() - before;
    benchmark::DoNotOptimize(delaunay.number_of_faces());
    mapTime += middle - begin;
    inserted = map.points.size() - views[0].points.size();
    state.SetIterationTime(middle - begin);
  }
  state.counters["inserted"] = static_cast<double>(inserted);
  state.counters["timeOverDelaunay"] = mapTime / delaunayTime;
  Times[scene][static_cast<int>(state.range(0))] = mapTime / state.iterations();
}

void FifthViolates(benchmark::State& state)
{
  const int n = static_cast<int>(state.range(0));
  Measure(state, "a fifth of the points violates", DomeViews(n - n / 5, n / 5, 0.05));
}
BENCHMARK(FifthViolates)
  ->Arg(10000)
  ->Arg(100000)
  ->Arg(1000000)
  ->UseManualTime()
  ->Unit(benchmark::kMillisecond);

void AllAreInserted(benchmark::State& state)
{
  const int n = static_cast<int>(state.range(0));
  Measure(state, "all points are inserted", DomeViews(4, n - 4, 0));
}
BENCHMARK(AllAreInserted)
  ->Arg(10000)
  ->Arg(100000)
  ->Arg(1000000)
  ->UseManualTime()
  ->Unit(benchmark::kMillisecond);

// A ring of views around a ball with bumps, each with as many features, which noise lifts a little.
std::vector<View> RingOfViews(int count, int features)
{
  std::mt19937 random(2);
  std::normal_distribution<double> normal, noise(0, 2e-4);
  std::vector<View> views;
  for (int v = 0; v < count; ++v)
  {
    View& view = views.emplace_back();
    view.camera.K << 1000, 0, 400, 0, 1000, 400, 0, 0, 1;
    view.camera.width = view.camera.height = 800;
    view.camera.R = Eigen::AngleAxisd(2 * M_PI * v / count, Eigen::Vector3d::UnitY()).matrix();
    view.camera.t = { 0, 0, 4 };
    const Eigen::Vector3d eye = view.camera.Center();
    while (view.points.size() < static_cast<std::size_t>(features))
    {
      const Eigen::Vector3d n =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      const double bump = std::sin(9 * n.x()) * std::sin(9 * n.y()) * std::sin(9 * n.z());
      const Eigen::Vector3d point = (1 + 0.05 * bump + noise(random)) * n;
      if (n.dot(eye - point) > 1)
      {
        view.points.push_back(point);
        view.imagePoints.push_back(view.camera.Project(point));
      }
    }
  }
  return views;
}

void ViewsOfARing(benchmark::State& state)
{
  const int count = static_cast<int>(state.range(0));
  const std::vector<View> views = RingOfViews(count, 2000);
  double time = 0;
  for (auto _ : state)
  {
    const double begin = Seconds();
    const FeatureCloud cloud(views);
    std::vector<DisparityMap> maps = TriangulateViews(views, cloud, {});
    ContinueBackground(maps, cloud, {});
    benchmark::DoNotOptimize(maps.data());
    time += Seconds() - begin;
    state.SetIterationTime(Seconds() - begin);
  }
  Times["a ring has n views"][count] = time / state.iterations();
}
BENCHMARK(ViewsOfARing)
  ->Arg(30)
  ->Arg(100)
  ->Arg(300)
  ->Arg(1000)
  ->Iterations(1)
  ->UseManualTime()
  ->Unit(benchmark::kMillisecond);

// The slope of the time over the number of points, both as logarithms.
double GrowthExponent(const std::map<int, double>& times)
{
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [n, seconds] : times)
  {
    const double logN = std::log(static_cast<double>(n)), logTime = std::log(seconds);
    x += logN;
    y += logTime;
    xx += logN * logN;
    xy += logN * logTime;
  }
  const double count = static_cast<double>(times.size());
  return (count * xy - x * y) / (count * xx - x * x);
}

}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  for (const auto& [scene, times] : Times)
  {
    if (times.size() > 1)
    {
      std::printf("Where %s, time grows with n^%.2f.\n", scene.c_str(), GrowthExponent(times));
    }
  }
}
