// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SurfaceMesh.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

namespace freespace
{

TriangleMesh MeshFromPolyData(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangulate;
  vtkSmartPointer<vtkPolyData> triangles = surface;
  if (surface->GetNumberOfStrips() > 0 || surface->GetPolys()->GetMaxCellSize() > 3)
  {
    triangulate->SetInputData(surface);
    triangulate->PassLinesOff();
    triangulate->PassVertsOff();
    triangulate->Update();
    triangles = triangulate->GetOutput();
  }
  TriangleMesh mesh;
  mesh.points.resize(triangles->GetNumberOfPoints());
  for (vtkIdType i = 0; i < triangles->GetNumberOfPoints(); ++i)
  {
    triangles->GetPoint(i, mesh.points[i].data());
  }
  mesh.triangles.reserve(triangles->GetNumberOfPolys());
  vtkCellArray* polys = triangles->GetPolys();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (polys->InitTraversal(); polys->GetNextCell(count, ids);)
  {
    if (count == 3)
    {
      mesh.triangles.push_back({ int(ids[0]), int(ids[1]), int(ids[2]) });
    }
  }
  return mesh;
}

vtkSmartPointer<vtkPoints> MovedPoints(vtkPolyData* surface, const Eigen::Vector3d& offset)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    surface->GetPoint(i, point.data());
    point += offset;
    points->SetPoint(i, point.data());
  }
  return points;
}

}
