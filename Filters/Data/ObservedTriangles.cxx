// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ObservedTriangles.h"

#include "Contour/Lattice/ContourField.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

namespace freespace
{

void KeepObserved(vtkPolyData* surface)
{
  auto* kinds = vtkUnsignedCharArray::SafeDownCast(surface->GetCellData()->GetArray("Kind"));
  auto* views = vtkIntArray::SafeDownCast(surface->GetCellData()->GetArray("View"));
  if (!kinds || !views)
  {
    return;
  }
  vtkUnsignedCharArray* ghosts = surface->GetPointGhostArray();
  vtkNew<vtkPoints> points;
  points->SetDataType(surface->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIntArray> view;
  view->SetName("View");
  vtkNew<vtkUnsignedCharArray> kind, ghost;
  kind->SetName("Kind");
  ghost->SetName(vtkDataSetAttributes::GhostArrayName());
  std::vector<vtkIdType> newId(surface->GetNumberOfPoints(), -1);
  vtkCellArray* all = surface->GetPolys();
  for (vtkIdType t = 0; t < all->GetNumberOfCells(); ++t)
  {
    if (kinds->GetValue(t) != static_cast<unsigned char>(SurfaceKind::Feature))
    {
      continue;
    }
    vtkIdType size;
    const vtkIdType* corners;
    vtkIdType ids[3];
    all->GetCellAtId(t, size, corners);
    for (int i = 0; i < 3; ++i)
    {
      vtkIdType& id = newId[corners[i]];
      if (id < 0)
      {
        id = points->InsertNextPoint(surface->GetPoint(corners[i]));
        ghost->InsertNextValue(ghosts ? ghosts->GetValue(corners[i]) : 0);
      }
      ids[i] = id;
    }
    triangles->InsertNextCell(3, ids);
    view->InsertNextValue(views->GetValue(t));
    kind->InsertNextValue(kinds->GetValue(t));
  }
  const bool isPiece = ghosts != nullptr;
  surface->Initialize();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  surface->GetCellData()->AddArray(view);
  surface->GetCellData()->AddArray(kind);
  if (isPiece)
  {
    surface->GetPointData()->AddArray(ghost);
  }
}

}
