// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RegionHull_h
#define freespace_RegionHull_h

#include "Common/DisparityMap.h"
#include "Freespace/FeatureHull.h"
#include "Freespace/SurfaceResolution.h"

#include <functional>
#include <memory>

namespace freespace
{

/// The features of the index-th of all disparity maps that are finite: not what was put behind an occluding
/// edge.
ViewFeatures FeaturesOfMap(const DisparityMap& map, std::size_t index);

/// The hull of the features in the region, and the lattice for it.
struct RegionHull
{
  std::unique_ptr<FeatureHull> hull;
  RegionOfInterest region;
  double cellSide = 0;                   ///< that the features ask for; 0 without any
  int cells = 0;                         ///< along the longest side of the region, for it
  std::vector<Eigen::Vector3d> features; ///< of all views, in the region
};

/// A share of the region's diagonal, for the numbers of lattice cells and of distances of the features along its
/// longest side.
using HullMargin = std::function<double(double cells, double distances)>;

/// Finds the region. The hull is pushed out by the margin.
RegionHull MakeRegionHull(const std::vector<ViewFeatures>& views, const RegionOptions& region,
  const ResolutionOptions& resolution, const HullMargin& margin, const ParallelFor& parallelFor,
  const Progress& progress);

}

#endif
