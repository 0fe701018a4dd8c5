// SPDX-License-Identifier: BSD-3-Clause
#include "Report/ReportNumbers.h"

#include "Data/ViewBlocks.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace freespace
{

namespace
{

/// Where the points of a map come from.
struct MapPoints
{
  long long own = 0;
  long long inserted = 0;
  long long continued = 0;
  long long triangles = 0;

  void Add(const MapPoints& other)
  {
    this->own += other.own;
    this->inserted += other.inserted;
    this->continued += other.continued;
    this->triangles += other.triangles;
  }
};

MapPoints CountPoints(const DisparityMap& map, int ownIndex)
{
  MapPoints count;
  count.triangles = static_cast<long long>(map.triangles.size());
  for (const int source : map.sourceView)
  {
    (source < 0 ? count.continued : source == ownIndex ? count.own : count.inserted) += 1;
  }
  return count;
}

std::vector<std::string> ViewRow(
  const std::string& name, long long features, const MapPoints& points)
{
  return { name, FormatCount(features), FormatCount(points.own), FormatCount(points.inserted),
    FormatCount(points.continued), FormatCount(points.triangles) };
}

}

ReportTable ViewTable(vtkMultiBlockDataSet* features, vtkMultiBlockDataSet* maps)
{
  ReportTable table;
  table.caption = "Views";
  table.columns = { "View", "Features", "Own in the map", "Brought in", "Background", "Triangles" };
  std::map<std::string, long long> found;
  for (unsigned int i = 0; i < features->GetNumberOfBlocks(); ++i)
  {
    found[BlockName(features, i)] =
      vtkPolyData::SafeDownCast(features->GetBlock(i))->GetNumberOfPoints();
  }
  const std::vector<DisparityMap> all = MapsFromBlocks(maps);
  MapPoints sum;
  long long allFound = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const MapPoints points = CountPoints(all[i], static_cast<int>(i));
    table.rows.push_back(ViewRow(all[i].name, found[all[i].name], points));
    sum.Add(points);
    allFound += found[all[i].name];
  }
  table.rows.push_back(ViewRow("All", allFound, sum));
  table.totalLast = true;
  table.notes = { "Features are those that stereo found; those of them that the neighbourhood "
                  "supports are the view's own in its map. Brought in are features of other views, "
                  "by the minimum disparity constraint; background points continue a surface "
                  "behind an occluding edge. Triangles are those of the view's disparity map." };
  return table;
}

ReportTable ChoiceTable(const std::vector<StageTime>& stages)
{
  ReportTable table;
  table.caption = "Chosen automatically";
  table.columns = { "", "" };
  for (const StageTime& stage : stages)
  {
    for (const auto& [what, choice] : stage.choices)
    {
      table.rows.push_back({ what, choice });
    }
  }
  return table;
}

ReportTable SurfaceTable(vtkPolyData* surface)
{
  const double* box = surface->GetBounds();
  ReportTable table = { "Surface", { "", "Count or length" },
    { { "Vertices", FormatCount(surface->GetNumberOfPoints()) },
      { "Triangles", FormatCount(surface->GetNumberOfPolys()) },
      { "Size of its box, units of the camera model",
        FormatNumber(box[1] - box[0]) + " × " + FormatNumber(box[3] - box[2]) + " × " +
          FormatNumber(box[5] - box[4]) } },
    false, {} };
  // A surface that was read from a file may not have it.
  vtkDataArray* lattice = surface->GetFieldData()->GetArray("Lattice");
  if (lattice && lattice->GetNumberOfTuples() == 3)
  {
    table.rows.push_back(
      { "Lattice cells along its longest side", FormatCount(std::llround(lattice->GetTuple1(0))) });
    table.rows.push_back(
      { "Features beyond the region", FormatCount(std::llround(lattice->GetTuple1(2))) });
  }
  return table;
}

ReportTable TimeTable(const std::vector<StageTime>& times)
{
  ReportTable table;
  table.caption = "Times by the clock";
  table.columns = { "Stage", "Time", "Made" };
  double sum = 0;
  for (const StageTime& time : times)
  {
    table.rows.push_back(
      { time.name, time.when == "given" ? "–" : FormatSeconds(time.seconds), time.when });
    sum += time.seconds;
  }
  table.rows.push_back({ "All", FormatSeconds(sum), "" });
  table.totalLast = true;
  return table;
}

ReportTable TruthTable(const TruthFigures& figures, std::size_t cameras)
{
  ReportTable table;
  table.caption = "Surface and truth, as the reference cameras see them";
  table.columns = { "" };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const char* shares[3] = { "0.1 %", "0.2 %", "0.5 %" };
    table.columns.push_back(
      "Within " + FormatNumber(figures.limits[i]) + " (" + shares[i] + " of the depth)");
  }
  const auto addRow = [&table](const char* name, double first, double second, double third) {
    table.rows.push_back({ name, FormatShare(first), FormatShare(second), FormatShare(third) });
  };
  addRow("Rays", figures.within[0], figures.within[1], figures.within[2]);
  addRow("Accuracy", figures.accuracy[0], figures.accuracy[1], figures.accuracy[2]);
  addRow("Completeness", figures.completeness[0], figures.completeness[1], figures.completeness[2]);
  addRow("F-score", figures.F(0), figures.F(1), figures.F(2));
  table.notes = { FormatCount(static_cast<long long>(figures.rays)) +
      " rays through a lattice of the pixels of " + std::to_string(cameras) +
      " reference cameras count: those whose true point lies in the convex hull of the features. " +
      FormatShare(figures.covered) + " of them hit the surface, with a median error of " +
      FormatNumber(figures.medianError) + "; " + FormatShare(figures.carved) +
      " hit it more than " + FormatNumber(figures.limits[2]) +
      " behind the truth (carved away) and " + FormatShare(figures.bulging) +
      " as much in front of it (bulging). Lengths are in the unit of "
      "the camera model.",
    "Rays: the error along the ray, surface against truth, is less than that. Accuracy: so many of "
    "the surface's points that the rays meet are so near to the truth. Completeness: so many of "
    "the "
    "truth's points are so near to the surface. F-score: their harmonic mean. The limits are "
    "shares "
    "of the median depth of the true points, " +
      FormatNumber(figures.medianDepth) + "." };
  return table;
}

long long InsertedFeatures(vtkMultiBlockDataSet* maps)
{
  long long inserted = 0;
  const std::vector<DisparityMap> all = MapsFromBlocks(maps);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    inserted += CountPoints(all[i], static_cast<int>(i)).inserted;
  }
  return inserted;
}

}
