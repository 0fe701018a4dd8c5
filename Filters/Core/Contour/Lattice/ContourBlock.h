// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourBlock_h
#define freespace_ContourBlock_h

#include "Contour/Lattice/BoundedField.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/Lattice.h"

#include <cstdint>
#include <vector>

namespace freespace
{

/// How a block finds and places its vertices; see ContourOptions.
struct CrossingOptions
{
  double tolerance = 1e-3;
  double clearance = 0.01;
  bool exact = true;
  bool keepNormals = false;
};

/// The contour within a block of cells: its vertices, by bisection along the lattice edges that
/// begin in the block, and the cells that the surface passes. Compact, as all blocks of a mesh
/// exist before the mesh does.
class ContourBlock
{
public:
  /// Cells along a side. Small blocks follow the surface closely, large ones share fewer points
  /// with their neighbours.
  static constexpr int Size = 8;

  ContourBlock(const BoundedField& field, const ContourLattice& lattice,
    const CrossingOptions& options, const CellRange& range, const FieldScope& scope);

  /// The key of a lattice edge: of its first point, relative to the block, and its axis.
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

  /// The position of a vertex; always computed here, so that it is always exactly the same.
  Eigen::Vector3d Position(const ContourLattice& lattice, std::size_t vertex) const;

  SurfaceKind Kind(std::size_t vertex) const { return SurfaceKind(this->Labels[vertex] & 3); }
  int View(std::size_t vertex) const { return this->Labels[vertex] >> 2; }

  /// Gives the views of the labels other numbers.
  template <typename ViewNow>
  void RenumberViews(const ViewNow& viewNow)
  {
    for (std::int16_t& label : this->Labels)
    {
      label = static_cast<std::int16_t>(viewNow(label >> 2) * 4 + (label & 3));
    }
  }

  LatticeIndex at; ///< of the block, in blocks

  // Vertices, in the order of their keys.
  std::vector<std::uint16_t> keys;
  std::vector<float> places;            ///< along the edge, 0 to 1
  std::vector<Eigen::Vector3f> normals; ///< of the surface there, if kept

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
