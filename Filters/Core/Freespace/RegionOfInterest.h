// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RegionOfInterest_h
#define freespace_RegionOfInterest_h

#include "Common/Camera.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"

#include <Eigen/Geometry>

#include <vector>

namespace freespace
{

/// What of a scene is reconstructed: the hull and the lattice are those of the features in this region.
struct RegionOptions
{
  enum class Mode
  {
    Automatic, ///< found from the features, see FindRegion
    All,       ///< all features (the paper)
    Box        ///< the features in `box`
  };
  Mode mode = Mode::Automatic;

  /// For Mode::Box, world coordinates; not empty.
  Eigen::AlignedBox3d box;

  /// How many per cent fewer of the features the region may hold where it becomes one per cent smaller;
  /// > 0, < 1. The features are weighted by how well they are triangulated.
  double lossForSize = 0.07;

  /// The same for the few that are left around the body of the scene; > 0, < 1.
  double lossAround = 0.005;

  /// What lies around the body, by this share of its longest side, belongs to it; >= 0.
  double surroundings = 0.25;

  /// All features are used unless the region is smaller than their box by this factor; >= 1.
  double leastGain = 1.5;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The features of one view.
struct ViewFeatures
{
  Camera camera;
  std::vector<Eigen::Vector3d> points;   ///< that it found itself: finite, world coordinates
  std::vector<Eigen::Vector3d> inserted; ///< that other views brought in
  double spacing = 1;                    ///< of its own in the image, about, pixels

  bool HasNone() const { return this->points.empty() && this->inserted.empty(); }
};

struct RegionOfInterest
{
  Eigen::AlignedBox3d box;  ///< of the features in it; empty without features
  std::size_t features = 0; ///< of all views
  std::size_t beyond = 0;   ///< of these, outside of the box
};

/// The region that matters. A few features far behind the scene, or thrown there by wrong matches, would
/// else decide how large the lattice is and so how fine.
///
/// Automatic: of all boxes the one that maximizes log N - p log D for p = lossForSize, the sum N of its
/// features' weights, and its diagonal D. A feature weighs the squared sine of the widest angle at which
/// another view looks at it: what its depth is worth, and little for a background that is seen past the
/// scene. Then what lies around this body is added. Boxes are searched by rounds of a ball around the
/// median and of an interval of each axis. Independent of scale and unit, the same in every run.
/// O(n log n), of at most some ten thousand features. Throws Error when an option is out of its range or a
/// given box holds no feature.
RegionOfInterest FindRegion(const std::vector<ViewFeatures>& views, const RegionOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = {});

}

#endif
