// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SurfaceMesh.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
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

}
