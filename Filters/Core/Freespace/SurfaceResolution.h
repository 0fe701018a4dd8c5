// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceResolution_h
#define freespace_SurfaceResolution_h

#include "Freespace/RegionOfInterest.h"

namespace freespace
{

/// The resolution of the lattice that resolves the features.
struct ResolutionOptions
{
  /// Side of a cell, as a share of the distance of the features on the surface; > 0.
  double cell = 1.4;

  /// Lower bound, in footprints of a pixel; > 0.
  double pixels = 2;

  /// Cells along the longest side of the region; 2 <= fewest <= most.
  int fewestCells = 256;
  int mostCells = 1024;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The side of a cell that the features in a box ask for: the median over them of what they cover of the surface,
/// by the footprint of a pixel where they are and by how far they are apart in the image. 0 without any.
double CellSide(const std::vector<ViewFeatures>& views, const Eigen::AlignedBox3d& box,
  const ResolutionOptions& options);

/// The lattice for it: how many cells lie along the longest side of the box.
int CellsAlong(const Eigen::AlignedBox3d& box, double cellSide, const ResolutionOptions& options);

}

#endif
