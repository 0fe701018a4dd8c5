// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OutlineTriangulation_h
#define freespace_OutlineTriangulation_h

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

namespace freespace
{

/// A closed polygon, the last point joined to the first one. A single point or a pair is allowed.
using Outline = std::vector<Eigen::Vector2d>;

/// Triangles that fill a part of the plane.
struct PlanarTriangles
{
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> triangles; ///< of one orientation: positive cross product
};

/// Triangulates what the outlines, of pieces and of their holes, bound: the constrained Delaunay triangulation of all
/// outlines, of which those triangles are kept whose centroid is inside. Outlines may touch and overlap. Empty where
/// no triangle is inside.
PlanarTriangles TriangulateOutlines(const std::vector<Outline>& outlines,
  const std::function<bool(const Eigen::Vector2d&)>& isInside);

}

#endif
