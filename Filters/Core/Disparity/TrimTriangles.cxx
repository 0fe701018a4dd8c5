// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/TrimTriangles.h"

#include "Common/Error.h"

#include <algorithm>

namespace freespace
{

namespace
{

bool IsTrusted(
  const DisparityMap& map, const std::array<int, 3>& triangle, const TrimOptions& options)
{
  double longest = 0, nearest = HUGE_VAL, farthest = 0;
  for (int i = 0; i < 3; ++i)
  {
    const int a = triangle[i], b = triangle[(i + 1) % 3];
    const double depth = map.camera.Depth(map.points[a]);
    longest = std::max(longest, (map.imagePoints[a] - map.imagePoints[b]).norm());
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  return (options.longestEdge == 0 || longest <= options.longestEdge) &&
    (options.greatestDepth == 0 || farthest <= options.greatestDepth * nearest);
}

}

void TrimOptions::Check() const
{
  if (!(this->longestEdge >= 0))
  {
    throw Error("The longest edge of a trusted triangle must not be negative.");
  }
  if (!(this->greatestDepth == 0 || this->greatestDepth > 1))
  {
    throw Error("The greatest depth ratio of a trusted triangle must be 0 or above 1.");
  }
}

void TrimTriangles(DisparityMap& map, const TrimOptions& options)
{
  options.Check();
  if (options.longestEdge == 0 && options.greatestDepth == 0)
  {
    return; // there is no limit
  }
  const auto untrusted = [&](const std::array<int, 3>& triangle)
  { return !IsTrusted(map, triangle, options); };
  map.triangles.erase(
    std::remove_if(map.triangles.begin(), map.triangles.end(), untrusted), map.triangles.end());
}

}
