// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Info/FileInfo.h"
#include "Info/SummaryInfo.h"

#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <nlohmann/json.hpp>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

void Append(std::vector<double>& all, const std::vector<double>& some)
{
  all.insert(all.end(), some.begin(), some.end());
}

std::vector<double> DepthsOf(const View& view)
{
  std::vector<double> depths;
  for (const Eigen::Vector3d& point : view.points)
  {
    depths.push_back(view.camera.Depth(point));
  }
  return depths;
}

// Distance of each feature's projection from its image point, in pixels.
std::vector<double> ErrorsOf(const View& view)
{
  std::vector<double> errors;
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    errors.push_back((view.camera.Project(view.points[i]) - view.imagePoints[i]).norm());
  }
  return errors;
}

std::vector<double> ValuesOf(vtkPolyData* block, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = block->GetPointData()->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

}

Json ViewsInfo(vtkMultiBlockDataSet* blocks)
{
  const auto views = WithoutSilhouettes(blocks);
  // Scalar arrays of the features that measure their reliability.
  const char* const qualities[] = { "MatchingCost", "DisparityDeviation", "ReprojectionError" };
  std::vector<double> depths, errors, values[3];
  Json rows = Json::array();
  std::int64_t features = 0, triangles = 0;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(views->GetBlock(i));
    const std::string name = BlockName(views, i);
    const View view = ViewFromBlock(block, name);
    const std::vector<double> ofView = DepthsOf(view);
    const Spread spread = SpreadOf(ofView);
    rows.push_back(
      { { "name", name }, { "image", view.imageFile }, { "features", block->GetNumberOfPoints() },
        { "triangles", block->GetNumberOfPolys() }, { "least_depth", spread.least },
        { "median_depth", spread.median }, { "greatest_depth", spread.greatest } });
    Append(depths, ofView);
    Append(errors, ErrorsOf(view));
    for (int k = 0; k < 3; ++k)
    {
      Append(values[k], ValuesOf(block, qualities[k]));
    }
    features += block->GetNumberOfPoints();
    triangles += block->GetNumberOfPolys();
  }
  Json info;
  info["kind"] = triangles > 0 ? "disparity maps" : "features";
  info["views"] = views->GetNumberOfBlocks();
  if (const unsigned int silhouettes = NumberOfSilhouettes(blocks))
  {
    info["silhouettes"] = silhouettes;
  }
  info["features"] = features;
  info["triangles"] = triangles;
  info["depths"] = SpreadInfo(SpreadOf(depths));
  info["deviations_in_pixels"] = SpreadInfo(SpreadOf(errors));
  for (int k = 0; k < 3; ++k)
  {
    if (!values[k].empty())
    {
      info[qualities[k]] = SpreadInfo(SpreadOf(values[k]));
    }
  }
  info["of_each_view"] = rows;
  return info;
}

}
