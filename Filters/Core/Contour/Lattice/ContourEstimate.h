// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourEstimate_h
#define freespace_ContourEstimate_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourOptions.h"

namespace freespace
{

/// About how large a contour will be, before it is made.
struct ContourEstimate
{
  double triangles = 0.0; ///< of the whole surface; 0 when the field cannot tell
  double megabytes = 0.0; ///< of memory for that and for making it, in MiB
};

/// Contours some blocks of a lattice of 256 cells at most, among those that the field cannot decide:
/// the octree of boxes is descended, and where boxes become many it goes on with some of them only,
/// evenly chosen. The cost does not depend on the cells. Within a tenth or two of the truth; a surface
/// that is rougher than 256 cells can show has more. A field that decides no box cannot tell.
ContourEstimate EstimateContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {});

/// The options' cells, or as many fewer as it takes for a contour to fit into their memory limit.
int CellsWithinMemory(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {});

/// The memory for a contour and for making it, in MiB.
double ContourMegabytes(double triangles, const ContourOptions& options, bool isSinglePrecision);

/// Throws Error when a contour of so many triangles does not fit into the options' memory limit.
void CheckMemoryLimit(double triangles, const ContourOptions& options, bool isSinglePrecision);

}

#endif
