// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourEstimate_h
#define freespace_ContourEstimate_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourOptions.h"

namespace freespace
{

/// An estimate of the size of a contour.
struct ContourEstimate
{
  double triangles = 0.0; ///< of the whole surface; 0 if unknown
  double megabytes = 0.0; ///< of memory for it and its computation, MiB
};

/// Contours some blocks of a lattice of 256 cells at most, among those that the field cannot decide:
/// the octree of boxes is traversed, and where there are many boxes, only an even selection of them. The
/// cost does not depend on the number of cells. The error is 10 to 20 percent; a surface with details
/// finer than 256 cells is larger. Unknown for a field that decides no box.
ContourEstimate EstimateContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {});

/// The options' number of cells, or fewer so that the contour fits into their memory limit.
int CellsWithinMemory(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {});

/// The memory for a contour and its computation, MiB.
double ContourMegabytes(double triangles, const ContourOptions& options, bool isSinglePrecision);

/// Throws Error when a contour with this number of triangles exceeds the options' memory limit.
void CheckMemoryLimit(double triangles, const ContourOptions& options, bool isSinglePrecision);

}

#endif
