// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_KeptContour_h
#define freespace_KeptContour_h

#include "Contour/Lattice/ContourOctree.h"

namespace freespace
{

/// The blocks of a contour, for the next one: about what ContourMegabytes says that a contour needs besides its mesh.
struct KeptContour
{
  Eigen::AlignedBox3d bounds;
  ContourOptions options;
  std::vector<Region> regions; ///< with their blocks; none: nothing is kept

  /// Whether blocks of a contour with these bounds and options are the same as those that are kept.
  bool Fits(const Eigen::AlignedBox3d& otherBounds, const ContourOptions& otherOptions) const
  {
    const ContourOptions &a = this->options, &b = otherOptions;
    return !this->regions.empty() && this->bounds.min() == otherBounds.min() &&
      this->bounds.max() == otherBounds.max() && a.cells == b.cells && a.tolerance == b.tolerance &&
      a.clearance == b.clearance && a.exact == b.exact && a.sharp == b.sharp && a.pieces == 1 &&
      b.pieces == 1;
  }
};

}

#endif
