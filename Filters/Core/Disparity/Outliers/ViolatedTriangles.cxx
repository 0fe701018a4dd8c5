// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/ViolatedTriangles.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

std::vector<char> ViolatedTriangles(const DisparityMap& map, const ViewFreespace& freespace,
  const FeatureCloud& cloud, int viewIndex, int leastFeatures, double relativeRoom)
{
  std::vector<int> violating(map.triangles.size(), 0), agreeing(map.triangles.size(), 0);
  cloud.VisitSeen(map.camera,
    [&](const FeatureCloud::Feature& feature)
    {
      if (feature.sourceView == viewIndex)
      {
        return;
      }
      const ViewFreespace::Sample sample = freespace.At(feature.point);
      if (sample.triangle >= 0)
      {
        const double room = relativeRoom * map.camera.Depth(feature.point);
        violating[sample.triangle] += sample.value > room;
        agreeing[sample.triangle] += std::abs(sample.value) <= room;
      }
    });
  std::vector<char> isViolated(map.triangles.size());
  std::transform(violating.begin(), violating.end(), agreeing.begin(), isViolated.begin(),
    [leastFeatures](int against, int with) { return against >= leastFeatures && against > with; });
  return isViolated;
}

std::vector<char> PointsBehindViolations(
  const DisparityMap& map, const std::vector<char>& isViolated)
{
  std::vector<int> around(map.points.size(), 0), dragged(map.points.size(), 0);
  for (std::size_t t = 0; t < map.triangles.size(); ++t)
  {
    const auto& corners = map.triangles[t];
    for (int corner : corners)
    {
      ++around[corner];
    }
    if (isViolated[t])
    {
      ++dragged[*std::max_element(corners.begin(), corners.end(),
        [&](int a, int b)
        { return map.camera.Depth(map.points[a]) < map.camera.Depth(map.points[b]); })];
    }
  }
  std::vector<char> isBehind(map.points.size());
  std::transform(dragged.begin(), dragged.end(), around.begin(), isBehind.begin(),
    [](int wrong, int all) { return 2 * wrong > all; });
  return isBehind;
}

}
