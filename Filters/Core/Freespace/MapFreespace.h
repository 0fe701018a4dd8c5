// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MapFreespace_h
#define freespace_MapFreespace_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Freespace/RegionHull.h"
#include "ViewFreespace/ViewFreespace.h"

#include <functional>
#include <memory>
#include <vector>

namespace freespace
{

/// What a union makes of one map without regard to the others. It never changes, so that unions share it: where a
/// map is added to a union or taken out, nothing is made anew for the others.
struct MapFreespace
{
  /// The index is that of the map in the union, see FeaturesOfMap. Throws Error when a triangle names a point
  /// that is not there; Aborted soon after the flag is set.
  MapFreespace(
    const DisparityMap& map, std::size_t index, const CancellationFlag& stop = NeverCancelled);

  ViewFeatures features;
  ViewFreespace freespace;
};

/// The maps of a union, in their order.
using SharedMaps = std::vector<std::shared_ptr<const MapFreespace>>;

/// Maps that need not all be in memory: each is requested once, used and released. The function is called from
/// several threads, one call at a time.
using MapSource = std::function<DisparityMap(std::size_t)>;

/// Makes those of the maps that are null. Throws as MapFreespace does, and Aborted when the progress asks to stop.
SharedMaps CompleteMaps(SharedMaps maps, const MapSource& mapOf, const ParallelFor& parallelFor,
  const Progress& progress);

}

#endif
