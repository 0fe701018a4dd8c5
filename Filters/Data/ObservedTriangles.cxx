// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ObservedTriangles.h"

#include "Common/GroupedLists.h"
#include "Contour/Lattice/ContourField.h"
#include "Mesh/SurfaceComponents.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

namespace freespace
{

const char* const SupportedName = "Supported";

namespace
{

vtkUnsignedCharArray* CellMarks(vtkPolyData* surface, const char* name)
{
  return vtkUnsignedCharArray::SafeDownCast(surface->GetCellData()->GetArray(name));
}

// Of a data set's arrays the tuples that are kept.
void KeepTuples(vtkDataSetAttributes* data, vtkIdList* kept)
{
  vtkNew<vtkDataSetAttributes> all;
  all->ShallowCopy(data);
  data->Initialize();
  for (int i = 0; i < all->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* from = all->GetAbstractArray(i);
    auto to = vtkSmartPointer<vtkAbstractArray>::Take(from->NewInstance());
    to->SetName(from->GetName());
    to->SetNumberOfComponents(from->GetNumberOfComponents());
    to->SetNumberOfTuples(kept->GetNumberOfIds());
    from->GetTuples(kept, to);
    data->AddArray(to);
  }
}

void KeepTriangles(vtkPolyData* surface, const std::vector<char>& isKept)
{
  vtkNew<vtkIdList> points, triangles;
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> newId(surface->GetNumberOfPoints(), -1);
  vtkCellArray* all = surface->GetPolys();
  for (vtkIdType t = 0; t < all->GetNumberOfCells(); ++t)
  {
    if (!isKept[t])
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
      id = id < 0 ? points->InsertNextId(corners[i]) : id;
      ids[i] = id;
    }
    cells->InsertNextCell(3, ids);
    triangles->InsertNextId(t);
  }
  vtkNew<vtkPoints> places;
  places->SetDataType(surface->GetPoints()->GetDataType());
  places->SetNumberOfPoints(points->GetNumberOfIds());
  surface->GetPoints()->GetPoints(points, places);
  surface->SetPoints(places);
  surface->SetPolys(cells);
  KeepTuples(surface->GetPointData(), points);
  KeepTuples(surface->GetCellData(), triangles);
}

// The corners of a triangle, the smallest first, with the triangle.
struct Rotated
{
  std::array<vtkIdType, 3> corners;
  vtkIdType triangle;

  bool operator<(const Rotated& other) const
  {
    return std::tie(this->corners, this->triangle) < std::tie(other.corners, other.triangle);
  }
};

// The triangles by their smallest corner.
GroupedLists<Rotated> ByFirstCorner(vtkCellArray* cells, vtkIdType points)
{
  return GroupedLists<Rotated>(points,
    [&](const auto& add)
    {
      for (vtkIdType t = 0; t < cells->GetNumberOfCells(); ++t)
      {
        vtkIdType size;
        const vtkIdType* ids;
        cells->GetCellAtId(t, size, ids);
        Rotated rotated = { { ids[0], ids[1], ids[2] }, t };
        std::rotate(rotated.corners.begin(),
          std::min_element(rotated.corners.begin(), rotated.corners.end()), rotated.corners.end());
        add(rotated.corners[0], rotated);
      }
    });
}

}

void DropRepeated(vtkPolyData* surface)
{
  const GroupedLists<Rotated> lists =
    ByFirstCorner(surface->GetPolys(), surface->GetNumberOfPoints());
  std::vector<char> isKept(lists.AllValues().size(), 1);
  bool areAllKept = true;
  std::vector<Rotated> sorted; // of one corner
  for (std::size_t corner = 0; corner < lists.NumberOfKeys(); ++corner)
  {
    sorted.assign(lists[corner].begin(), lists[corner].end());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
    {
      if (sorted[i].corners == sorted[i - 1].corners)
      {
        isKept[sorted[i].triangle] = 0;
        areAllKept = false;
      }
    }
  }
  if (!areAllKept)
  {
    const std::string scalars =
      surface->GetPointData()->GetScalars() && surface->GetPointData()->GetScalars()->GetName()
      ? surface->GetPointData()->GetScalars()->GetName()
      : "";
    KeepTriangles(surface, isKept);
    surface->GetPointData()->SetActiveScalars(scalars.c_str());
  }
}

void KeepObserved(vtkPolyData* surface)
{
  vtkUnsignedCharArray* kinds = CellMarks(surface, "Kind");
  vtkUnsignedCharArray* supported = CellMarks(surface, SupportedName);
  if (!kinds)
  {
    return;
  }
  std::vector<char> isKept(surface->GetNumberOfPolys());
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    isKept[t] = kinds->GetValue(t) == static_cast<unsigned char>(SurfaceKind::Feature) ||
      (supported && supported->GetValue(t) != 0);
  }
  KeepTriangles(surface, isKept);
}

std::int64_t DropCrumbs(vtkPolyData* surface)
{
  vtkUnsignedCharArray* supported = CellMarks(surface, SupportedName);
  if (!supported || surface->GetNumberOfPolys() == 0)
  {
    return 0;
  }
  std::vector<std::array<std::int64_t, 3>> triangles;
  std::vector<char> isSupported;
  triangles.reserve(surface->GetNumberOfPolys());
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    vtkIdType size;
    const vtkIdType* corners;
    surface->GetPolys()->GetCellAtId(t, size, corners);
    triangles.push_back({ corners[0], corners[1], corners[2] });
    isSupported.push_back(supported->GetValue(t) != 0);
  }
  const std::vector<char> isKept =
    SupportedComponents(ComponentsOf(triangles, surface->GetNumberOfPoints()), isSupported);
  const auto dropped = std::count(isKept.begin(), isKept.end(), 0);
  if (dropped > 0)
  {
    KeepTriangles(surface, isKept);
  }
  return dropped;
}

}
