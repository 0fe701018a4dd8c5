// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourBlock_h
#define freespace_ContourBlock_h

#include "Contour/Lattice/ContourField.h"

#include <array>
#include <cstdint>

namespace freespace
{

/// Places in a lattice: of points, cells or blocks.
using LatticeIndex = std::array<int, 3>;

/// The regular lattice that a contour is taken over. Cells are cubes.
struct ContourLattice
{
  Eigen::Vector3d origin; ///< the first point
  double spacing = 0.0;   ///< between points
  LatticeIndex cells;     ///< along each axis; there is one point more

  /// The lattice for a box: its outermost points lie half a cell (or more) outside of the box, so
  /// that the box's faces are crossed between points.
  ContourLattice(const Eigen::AlignedBox3d& bounds, int cellsAlongLongestSide);

  Eigen::Vector3d Point(int i, int j, int k) const
  {
    return this->origin + this->spacing * Eigen::Vector3d(i, j, k);
  }
};

/// A range of cells along each axis, from low up to but without high.
struct CellRange
{
  LatticeIndex low, high;

  int Longest() const;
  Eigen::AlignedBox3d Box(const ContourLattice& lattice) const;

  /// The up to eight parts that the range falls into when it is halved along each axis at a
  /// multiple of the step, in a fixed order.
  std::vector<CellRange> Parts(int step) const;
};

/// A field within bounds; outside of them is free.
class BoundedField
{
public:
  BoundedField(const ContourField& field, const Eigen::AlignedBox3d& bounds)
    : Field(field)
    , Bounds(bounds)
  {
  }

  bool IsFree(const Eigen::Vector3d& point, const FieldScope& scope) const
  {
    return !this->Bounds.contains(point) || this->Field.IsFree(point, scope);
  }

  BoxContent Classify(
    const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const;

  bool Crossing(const Eigen::Vector3d& matter, const Eigen::Vector3d& free, const FieldScope& scope,
    double& place, SurfaceLabel& label) const;

  SurfaceLabel Label(
    const Eigen::Vector3d& free, const Eigen::Vector3d& matter, const FieldScope& scope) const;

  FieldScope Root() const { return this->Field.Root(); }
  const ContourField& Inner() const { return this->Field; }
  const Eigen::AlignedBox3d& Box() const { return this->Bounds; }

private:
  const ContourField& Field;
  const Eigen::AlignedBox3d Bounds;
};

/// How a block finds and places its vertices; see ContourOptions.
struct CrossingOptions
{
  double tolerance = 1e-3;
  double clearance = 0.01;
  bool exact = true;
  bool keepNormals = false;
};

/// The contour within a block of cells: its vertices, by bisection along the lattice edges that
/// begin in the block, and the cells that the surface passes. Kept small: all blocks of a mesh
/// exist before the mesh does.
class ContourBlock
{
public:
  /// Cells along a side. Small blocks follow the surface closely, large ones share fewer points
  /// with their neighbours.
  static constexpr int Size = 8;

  ContourBlock(const BoundedField& field, const ContourLattice& lattice,
    const CrossingOptions& options, const CellRange& range, const FieldScope& scope);

  /// A lattice edge's place in the block: of its first point, and its axis.
  static std::uint16_t Key(const LatticeIndex& point, int axis)
  {
    return static_cast<std::uint16_t>(3 * ((point[2] * Size + point[1]) * Size + point[0]) + axis);
  }
  static std::uint16_t CellKey(const LatticeIndex& cell)
  {
    return static_cast<std::uint16_t>((cell[2] * Size + cell[1]) * Size + cell[0]);
  }
  static LatticeIndex PointOf(std::uint16_t key)
  {
    const int point = key / 3;
    return { point % Size, point / Size % Size, point / (Size * Size) };
  }

  /// A vertex's position; no other way gives exactly the same.
  Eigen::Vector3d Position(const ContourLattice& lattice, std::size_t vertex) const;

  SurfaceKind Kind(std::size_t vertex) const { return SurfaceKind(this->Labels[vertex] & 3); }
  int View(std::size_t vertex) const { return this->Labels[vertex] >> 2; }

  LatticeIndex at; ///< of the block, in blocks

  // Vertices, in the order of their keys.
  std::vector<std::uint16_t> keys;
  std::vector<float> places;            ///< along the edge, 0 to 1
  std::vector<Eigen::Vector3f> normals; ///< of the surface there, when wanted

  // Cells that the surface passes.
  std::vector<std::uint16_t> cells; ///< their keys, ascending
  std::vector<std::uint8_t> cases;  ///< their corners in matter, see MarchingCubesCases

  std::size_t NumberOfTriangles() const;

private:
  std::vector<std::int16_t> Labels; ///< of the vertices: 4 * view + kind
  friend class BlockSampler;
};

}

#endif
