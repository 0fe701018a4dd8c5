// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TrimTriangles_h
#define freespace_TrimTriangles_h

#include "Common/DisparityMap.h"

namespace freespace
{

/// Which triangles of a disparity map are too long to be believed. The free space theorem rests on
/// features wherever the surface ends; where they are sparse, nothing says that a long triangle is
/// the surface.
struct TrimOptions
{
  double longestEdge = 0; ///< in the image, pixels; >= 0; 0 is no limit (the paper)
  double greatestDepth =
    0; ///< of a triangle's farthest corner over that of its nearest; 0 (no limit:
       ///< the paper) or > 1

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Takes untrusted triangles out of a map, so that the view claims no free space there. Points stay.
void TrimTriangles(DisparityMap& map, const TrimOptions& options);

}

#endif
