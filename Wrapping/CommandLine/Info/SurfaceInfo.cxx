// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SurfaceMesh.h"
#include "Info/FileInfo.h"
#include "Info/SummaryInfo.h"
#include "Mesh/SurfaceSummary.h"

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <nlohmann/json.hpp>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

Json NamesOf(vtkDataSetAttributes* arrays)
{
  Json names = Json::array();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    names.push_back(arrays->GetArrayName(i) ? arrays->GetArrayName(i) : "");
  }
  return names;
}

}

Json SurfaceInfo(vtkPolyData* surface)
{
  const SurfaceSummary summary = Summarize(MeshFromPolyData(surface));
  Json info;
  info["kind"] = "surface";
  info["points"] = summary.points;
  info["triangles"] = summary.triangles;
  info["bounds"] = BoundsInfo(summary.bounds);
  info["area"] = summary.area;
  info["components"] = summary.components;
  info["closed"] = summary.IsClosed();
  if (summary.IsClosed())
  {
    info["volume"] = summary.volume;
  }
  info["edges"] = summary.edges;
  info["border_edges"] = summary.borderEdges;
  info["edges_of_more_than_two_triangles"] = summary.crowdedEdges;
  info["edges_between_contrary_triangles"] = summary.contraryEdges;
  info["euler_characteristic"] = summary.EulerCharacteristic();
  info["triangles_without_area"] = summary.flatTriangles;
  info["points_without_triangles"] = summary.unusedPoints;
  info["point_arrays"] = NamesOf(surface->GetPointData());
  info["triangle_arrays"] = NamesOf(surface->GetCellData());
  return info;
}

}
