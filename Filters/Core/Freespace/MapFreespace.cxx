// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/MapFreespace.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"

#include <mutex>
#include <string>

namespace freespace
{

namespace
{

const DisparityMap& WithValidTriangles(const DisparityMap& map)
{
  const int n = static_cast<int>(map.points.size());
  for (const auto& triangle : map.triangles)
  {
    for (int corner : triangle)
    {
      if (corner < 0 || corner >= n)
      {
        throw Error("The map " + map.name + " has a triangle that names point " +
          std::to_string(corner) + " of " + std::to_string(n) + ".");
      }
    }
  }
  return map;
}

}

MapFreespace::MapFreespace(const DisparityMap& map, std::size_t index, const CancellationFlag& stop)
  : features(FeaturesOfMap(WithValidTriangles(map), index))
  , freespace(map, stop)
{
}

SharedMaps CompleteMaps(
  SharedMaps maps, const MapSource& mapOf, const ParallelFor& parallelFor, const Progress& progress)
{
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    if (!maps[i])
    {
      missing.push_back(i);
    }
  }
  std::mutex asking;
  ParallelForWithProgress(missing.size(), parallelFor, progress,
    [&](std::size_t m, const CancellationFlag& stop)
    {
      const std::size_t i = missing[m];
      const DisparityMap map = [&]
      {
        const std::lock_guard<std::mutex> lock(asking);
        ThrowIfCancelled(stop);
        return mapOf(i);
      }();
      maps[i] = std::make_shared<const MapFreespace>(map, i, stop);
    });
  return maps;
}

}
