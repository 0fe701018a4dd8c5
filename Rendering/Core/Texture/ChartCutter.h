// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ChartCutter_h
#define freespace_ChartCutter_h

#include "Texture/Chart.h"
#include "Texture/SurfaceGeometry.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace freespace
{

/// Cuts a surface into charts, which grow over the neighbours of their triangles. A chart is a height
/// field along one axis of space and has no triangle steeper than 66 degrees but its first.
class ChartCutter
{
public:
  /// Keeps a reference to the surface. Takes only triangles that are seen; the side of a texel is the
  /// resolution at which overlaps are found.
  ChartCutter(
    const SurfaceGeometry& surface, const std::vector<char>& seenTriangles, double texelSide);

  /// All charts; once.
  std::vector<Chart> Cut();

private:
  Chart Grow(int seed);
  bool Fits(const Chart& chart, int triangle);

  const SurfaceGeometry& Surface;
  double Texel;
  std::vector<char> Free;
  std::unordered_map<std::uint64_t, float> Heights; // of the chart that grows
};

}

#endif
