// SPDX-License-Identifier: BSD-3-Clause
// Distances of a surface's points to a reference and back: this project's, CGAL's AABB_tree with as many threads, and
// vtkDistancePolyDataFilter, on the same two surfaces in one run, taking turns.
//
//     BenchmarkSurfaceComparison [MESH.ply REFERENCE.ply]
//
// Without files the surfaces are two contours of blocks, one of them a little larger and finer.
#include "Data/SurfaceMesh.h"
#include "Execution/SMPParallelFor.h"
#include "Mesh/Distance/TriangleTree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <vtkBox.h>
#include <vtkContourFilter.h>
#include <vtkDataArray.h>
#include <vtkDistancePolyDataFilter.h>
#include <vtkImplicitBoolean.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSampleFunction.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>

using namespace freespace;

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Primitive =
  CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Distances = std::vector<double>;

vtkSmartPointer<vtkPolyData> Read(const char* fileName)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(fileName);
  reader->Update();
  return reader->GetOutput();
}

// Nine boxes on a floor.
vtkSmartPointer<vtkPolyData> Blocks(double growth, int cells)
{
  vtkNew<vtkImplicitBoolean> scene;
  scene->SetOperationTypeToUnion();
  const auto add = [&](double x, double y, double z, double half)
  {
    vtkNew<vtkBox> box;
    const double side = half + growth;
    box->SetBounds(x - side, x + side, y - side, y + side, z - growth, z + half + growth);
    scene->AddFunction(box);
  };
  add(0, 0, -0.4, 0.9);
  for (int i = 0; i < 9; ++i)
  {
    add(0.5 * (i % 3 - 1), 0.5 * (i / 3 - 1), 0.3, 0.1 + 0.01 * i);
  }
  vtkNew<vtkSampleFunction> sample;
  sample->SetImplicitFunction(scene);
  sample->SetModelBounds(-1.1, 1.1, -1.1, 1.1, -0.6, 1.0);
  sample->SetSampleDimensions(cells, cells, cells);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(sample->GetOutputPort());
  contour->SetValue(0, 0);
  contour->Update();
  return contour->GetOutput();
}

Distances Own(vtkPolyData* from, vtkPolyData* to)
{
  const TriangleMesh mesh = MeshFromPolyData(to), points = MeshFromPolyData(from);
  const auto found =
    TriangleTree(mesh, SMPParallelFor).Find(points.points, HUGE_VAL, SMPParallelFor);
  Distances distances;
  for (const NearestPlace& place : found)
  {
    distances.push_back(place.distance);
  }
  return distances;
}

Distances Cgal(vtkPolyData* from, vtkPolyData* to)
{
  const TriangleMesh mesh = MeshFromPolyData(to);
  const auto point = [](const double* p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  std::vector<Kernel::Triangle_3> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    triangles.emplace_back(
      point(mesh.points[a].data()), point(mesh.points[b].data()), point(mesh.points[c].data()));
  }
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  Distances distances(from->GetNumberOfPoints());
  vtkSMPTools::For(0, from->GetNumberOfPoints(), 1024,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        double p[3];
        from->GetPoint(i, p);
        distances[i] = std::sqrt(tree.squared_distance(point(p)));
      }
    });
  return distances;
}

std::pair<Distances, Distances> Vtk(vtkPolyData* surface, vtkPolyData* reference)
{
  vtkNew<vtkDistancePolyDataFilter> filter;
  filter->SetInputData(0, surface);
  filter->SetInputData(1, reference);
  filter->SignedDistanceOff();
  filter->ComputeCellCenterDistanceOff();
  filter->Update();
  const auto values = [](vtkPolyData* output)
  {
    vtkDataArray* array = output->GetPointData()->GetArray("Distance");
    Distances distances;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      distances.push_back(std::abs(array->GetTuple1(i)));
    }
    return distances;
  };
  return { values(filter->GetOutput()), values(filter->GetSecondDistanceOutput()) };
}

double Difference(const Distances& one, const Distances& other)
{
  double greatest = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    greatest = std::max(greatest, std::abs(one[i] - other[i]));
  }
  return greatest;
}

}

int main(int argc, char* argv[])
{
  const auto surface = argc == 3 ? Read(argv[1]) : Blocks(0.003, 160);
  const auto reference = argc == 3 ? Read(argv[2]) : Blocks(0, 120);
  std::pair<Distances, Distances> own, cgal, vtk;
  const std::pair<const char*, std::function<void()>> ways[] = {
    { "this project",
      [&] {
        own = { Own(surface, reference), Own(reference, surface) };
      } },
    { "CGAL's AABB_tree",
      [&] {
        cgal = { Cgal(surface, reference), Cgal(reference, surface) };
      } },
    { "vtkDistancePolyDataFilter", [&] { vtk = Vtk(surface, reference); } }
  };
  double best[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  for (int turn = 0; turn < 5; ++turn)
  {
    for (int way = 0; way < 3; ++way)
    {
      const auto begin = std::chrono::steady_clock::now();
      ways[way].second();
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
      best[way] = std::min(best[way], seconds.count());
    }
  }
  std::cout << surface->GetNumberOfPoints() << " and " << reference->GetNumberOfPoints()
            << " points, both ways, " << vtkSMPTools::GetEstimatedNumberOfThreads()
            << " threads, best of 5 turns\n";
  for (int way = 0; way < 3; ++way)
  {
    std::cout << ways[way].first << ": " << 1000 * best[way] << " ms, " << best[way] / best[0]
              << " times this project's\n";
  }
  std::cout << "greatest difference to CGAL's distances "
            << std::max(Difference(own.first, cgal.first), Difference(own.second, cgal.second))
            << ", to VTK's "
            << std::max(Difference(own.first, vtk.first), Difference(own.second, vtk.second))
            << "\n";
  return 0;
}
