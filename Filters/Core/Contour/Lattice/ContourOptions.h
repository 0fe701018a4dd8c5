// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourOptions_h
#define freespace_ContourOptions_h

#include <Eigen/Geometry>

namespace freespace
{

/// How a field is contoured.
struct ContourOptions
{
  int cells = 256; ///< of the lattice along its longest side; >= 2; for a field that suggests none
  double tolerance = 1e-3; ///< of the bisection, as a fraction of a cell; in (0, 0.5]
  double clearance = 0.01; ///< vertices keep so far from the lattice's points, as a fraction of a
                           ///< cell, lest triangles vanish; in (0, 0.25]
  bool exact = true;       ///< use crossings of the field where it provides them, see
                           ///< ContourField::Crossing; the tolerance is for all others
  bool sharp = true;       ///< rebuild sharp edges and corners from the normals at the crossings
  double sharpAngle =
    60;           ///< between two normals of a cell that make it sharp, degrees; in (0, 180)
  int piece = 0;  ///< which of the pieces to make; in [0, pieces)
  int pieces = 1; ///< that together are the surface; >= 1
  double memoryLimit = 0; ///< for the piece and for making it, MiB; 0: none

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Whether points in single precision keep the surface free of degenerate triangles.
bool SinglePrecisionSuffices(const Eigen::AlignedBox3d& bounds, const ContourOptions& options);

}

#endif
