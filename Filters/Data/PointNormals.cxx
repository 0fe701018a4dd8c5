// SPDX-License-Identifier: BSD-3-Clause
#include "Data/PointNormals.h"

#include "Execution/Sequentially.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

namespace freespace
{

void ComputePointNormals(vtkPolyData* surface)
{
  vtkNew<vtkPolyData> triangles;
  triangles->SetPoints(surface->GetPoints());
  triangles->SetPolys(surface->GetPolys());
  vtkNew<vtkPolyDataNormals> filter;
  filter->SetInputData(triangles);
  filter->SplittingOff();
  filter->ConsistencyOff(); // it is
  Sequentially([&] { filter->Update(); });
  if (vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals())
  {
    normals->SetName("Normals");
    surface->GetPointData()->SetNormals(normals);
  }
}

}
