// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourMesh_h
#define freespace_ContourMesh_h

#include "Contour/Lattice/ContourField.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace freespace
{

/// Where a contour writes its mesh: three values to a point and to a triangle, one to a label.
/// Points go to either precision, the other is null; so may be the labels.
struct ContourArrays
{
  float* singlePoints = nullptr;
  double* doublePoints = nullptr;
  std::int32_t* triangles = nullptr; ///< counter-clockwise from the free side
  std::int32_t* view = nullptr;      ///< per triangle: the view that carved it, -1 the hull
  SurfaceKind* kind = nullptr;       ///< per triangle
};

/// How large a contour is.
struct ContourSize
{
  std::size_t points = 0;
  std::size_t ownPoints = 0; ///< of these: the points after them belong to other pieces
  std::size_t triangles = 0;
};

/// Provides the arrays when their sizes are known, so that no copy of a large mesh is made.
using AllocateContour = std::function<ContourArrays(const ContourSize& size)>;

/// A mesh with its own memory, for callers without arrays.
struct ContourMesh
{
  std::vector<Eigen::Vector3d> points;
  std::size_t ownPoints = 0;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> view;
  std::vector<SurfaceKind> kind;
};

}

#endif
