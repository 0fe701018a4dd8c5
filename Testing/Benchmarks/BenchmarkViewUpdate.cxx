// SPDX-License-Identifier: BSD-3-Clause

// What a 31st view costs, added to 30 and removed again, against all of them from nothing: vtkFreespaceUnion and
// vtkBisectionContourFilter with Incremental. Over a landscape, of which a view sees a part, and around a ball, of which
// it sees almost half. Prints the times, their ratios and whether the surfaces are the same.
//
//   BenchmarkViewUpdate [CELLS]

#include "Common/ParseNumber.h"
#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCellArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr int Views = 31;

// Positive outside of a body.
using Body = std::function<double(const Vector3d&)>;

double Landscape(const Vector3d& x)
{
  const double hills = 0.15 * std::sin(1.3 * x.x()) * std::cos(1.7 * x.y());
  const bool isHouse =
    std::fmod(std::abs(x.x()) + 0.3, 1.0) < 0.4 && std::fmod(std::abs(x.y()) + 0.2, 1.0) < 0.4;
  return x.z() - hills - (isHouse ? 0.25 : 0.0);
}

double Ball(const Vector3d& x)
{
  const Vector3d d = x.normalized();
  return x.norm() - 1 - 0.06 * std::sin(9 * d.x()) * std::sin(8 * d.y()) * std::cos(7 * d.z());
}

// By steps, and bisection of the last one.
double DepthOf(const Body& body, const Camera& camera, const Vector2d& pixel)
{
  constexpr double step = 0.03;
  double depth = 0.5;
  while (depth < 8 && body(camera.Unproject(pixel, depth)) > 0)
  {
    depth += step;
  }
  for (double half = step / 2; half > 1e-5; half /= 2)
  {
    depth += body(camera.Unproject(pixel, depth)) > 0 ? half : -half;
  }
  return depth;
}

// What a camera sees of the body: a jittered grid of features, triangulated.
DisparityMap Seen(const Body& body, const Camera& camera, int index)
{
  constexpr int along = 110, across = 88;
  std::mt19937 random(static_cast<unsigned int>(index));
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  DisparityMap map;
  map.name = "view" + std::to_string(index);
  map.camera = camera;
  std::vector<char> isHit;
  for (int i = 0; i < along * across; ++i)
  {
    const Vector2d pixel((i % along + 0.5 + jitter(random)) * camera.width / along,
      (i / along + 0.5 + jitter(random)) * camera.height / across);
    const double depth = DepthOf(body, camera, pixel);
    isHit.push_back(depth < 7.9);
    map.imagePoints.push_back(pixel);
    map.points.push_back(camera.Unproject(pixel, depth));
    map.sourceView.push_back(index);
  }
  for (int i = 0; i < along * (across - 1); ++i)
  {
    const int a = i, b = i + 1, c = i + along, d = c + 1;
    if (i % along + 1 < along && isHit[a] && isHit[b] && isHit[c] && isHit[d])
    {
      map.triangles.push_back({ a, b, d });
      map.triangles.push_back({ a, d, c });
    }
  }
  // Features that nothing was seen at are none.
  for (std::size_t p = 0; p < map.points.size(); ++p)
  {
    map.points[p] = isHit[p] ? map.points[p] : Vector3d::Constant(NAN);
  }
  return map;
}

Camera OverLandscape(int i)
{
  const Vector3d place =
    i == 0 ? Vector3d(0.3, 0.2, 0) : Vector3d(1.1 * (i % 6 - 2.5), 1.1 * (i / 6 - 2.5), 0);
  return LookingAt(place + Vector3d(0.05, 0.03, 2.2), place);
}

Camera AroundBall(int i)
{
  const double z = 1 - (2.0 * i + 1) / Views, angle = i * M_PI * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return LookingAt(3.2 * Vector3d(r * std::cos(angle), r * std::sin(angle), z), Vector3d::Zero());
}

double Seconds(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

bool AreSame(vtkPolyData* a, vtkPolyData* b)
{
  bool areSame = a->GetNumberOfPoints() == b->GetNumberOfPoints() &&
    a->GetNumberOfPolys() == b->GetNumberOfPolys();
  for (vtkIdType i = 0; areSame && i < a->GetNumberOfPoints(); ++i)
  {
    areSame = Vector3d(a->GetPoint(i)) == Vector3d(b->GetPoint(i));
  }
  for (vtkIdType i = 0; areSame && i < a->GetNumberOfPolys(); ++i)
  {
    vtkIdType n, m;
    const vtkIdType *corners, *others;
    a->GetPolys()->GetCellAtId(i, n, corners);
    const std::array<vtkIdType, 3> own = { corners[0], corners[1], corners[2] };
    b->GetPolys()->GetCellAtId(i, m, others);
    areSame = std::equal(own.begin(), own.end(), others);
  }
  return areSame;
}

struct Pipeline
{
  Pipeline(const double bounds[6], int cells)
  {
    this->Phi->SetHullMargin(0.02);
    this->Phi->SetRegion(bounds);
    this->Contour->SetImplicitFunction(this->Phi);
    this->Contour->SetBounds(const_cast<double*>(bounds));
    this->Contour->SetCells(cells);
    this->Contour->IncrementalOn();
  }
  vtkNew<vtkFreespaceUnion> Phi;
  vtkNew<vtkBisectionContourFilter> Contour;
};

void Compare(
  const char* name, const Body& body, Camera (*cameraOf)(int), const double bounds[6], int cells)
{
  std::vector<vtkSmartPointer<vtkPolyData>> maps;
  for (int i = 0; i < Views; ++i)
  {
    // The last view is one in the middle.
    maps.push_back(BlockFromMap(Seen(body, cameraOf((i + 1) % Views), i)));
  }
  Pipeline kept(bounds, cells), fresh(bounds, cells);
  for (int i = 0; i < Views; ++i)
  {
    (i + 1 < Views ? kept : fresh)
      .Phi->AddView("view" + std::to_string(i), maps[static_cast<std::size_t>(i)]);
  }
  vtkNew<vtkMultiBlockDataSet> all;
  for (int i = 0; i < Views; ++i)
  {
    SetNamedBlock(all, static_cast<unsigned int>(i), "view" + std::to_string(i),
      maps[static_cast<std::size_t>(i)]);
  }
  fresh.Phi->SetMaps(nullptr);
  fresh.Phi->SetMaps(all);
  kept.Contour->Update();
  const double nothing = Seconds([&] { fresh.Contour->Update(); });
  const double phi = Seconds(
    [&]
    {
      kept.Phi->AddView("view30", maps.back());
      kept.Phi->Update();
    });
  const double added = phi + Seconds([&] { kept.Contour->Update(); });
  const bool areSame = AreSame(kept.Contour->GetOutput(), fresh.Contour->GetOutput());
  const double removed = Seconds(
    [&]
    {
      kept.Phi->RemoveView("view30");
      kept.Contour->Update();
    });
  std::printf("%s, %d views, %d cells, %lld triangles\n", name, Views, cells,
    static_cast<long long>(fresh.Contour->GetOutput()->GetNumberOfPolys()));
  std::printf("  from nothing   %7.3f s\n", nothing);
  std::printf("  AddView        %7.3f s  1/%.1f  (the function %.3f s)  %s\n", added,
    nothing / added, phi, areSame ? "the same surface" : "ANOTHER SURFACE");
  std::printf("  RemoveView     %7.3f s  1/%.1f\n", removed, nothing / removed);
}

}

int main(int argc, char** argv)
{
  const auto number = freespace::ParseNumber<int>(argc > 1 ? argv[1] : "384");
  if (!(number && *number > 1))
  {
    std::fprintf(stderr, "Usage: BenchmarkViewUpdate [CELLS]\n");
    return 2;
  }
  const int cells = *number;
  const double land[6] = { -3.5, 3.5, -3.5, 3.5, -0.5, 0.6 },
               ball[6] = { -1.2, 1.2, -1.2, 1.2, -1.2, 1.2 };
  Compare("landscape", Landscape, OverLandscape, land, cells);
  Compare("ball", Ball, AroundBall, ball, cells);
  return 0;
}
