// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourOctree_h
#define freespace_ContourOctree_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourBlock.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourOptions.h"

#include <unordered_set>

namespace freespace
{

/// A part of the lattice that the surface may pass.
struct Region
{
  CellRange range;
  FieldScope scope;
  bool isOwn; ///< of this piece; otherwise only its vertices are wanted
  int layer;
  std::vector<ContourBlock> blocks;
};

/// One number for a place in a lattice, none of whose indices is negative.
std::uint64_t LatticeKey(const LatticeIndex& at);

/// The parts of a lattice that a surface passes, found by descending it as an octree of boxes that the
/// field classifies, and the blocks in them. Blocks depend on the lattice alone, not on threads or
/// pieces.
class ContourOctree
{
public:
  ContourOctree(
    const ContourField& whole, const Eigen::AlignedBox3d& bounds, const ContourOptions& options);

  /// Finds the regions of the options' piece with their blocks, and of those next to them what the
  /// piece's triangles need. Throws Error when the surface will not fit into the memory limit.
  void Find(const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe);

  const BoundedField field;
  const ContourLattice lattice;
  const bool isSingle;         ///< points in single precision suffice
  std::vector<Region> regions; ///< layer by layer

private:
  /// Refuses surfaces that are too large, before the work.
  void CheckEstimate(const Progress& progress) const;

  /// The regions of this piece, and those next to them, whose vertices its triangles need.
  void FindRegions(const Progress& progress);

  void KeepPiece();

  /// Whether a box of cells touches a region of this piece such that this needs vertices of it.
  bool IsBesideOwn(const LatticeIndex& low, int size) const;

  void FindBlocks(const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe);

  void RunRegion(Region& region, const Progress& progress, double fraction) const;

  const ContourOptions Options;
  const CrossingOptions Crossing;
  std::unordered_set<std::uint64_t> OwnRegions; ///< of this piece, when it is not the whole
};

}

#endif
