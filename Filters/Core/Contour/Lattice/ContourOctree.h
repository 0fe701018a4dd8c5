// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourOctree_h
#define freespace_ContourOctree_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourBlock.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourOptions.h"
#include "Contour/Lattice/FieldChange.h"

#include <unordered_map>
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
  std::vector<ContourBlock>
    before = {};           ///< of an earlier contour, to be taken over where nothing changed
  ChangeScope change = {}; ///< since then
  bool isLeft = false;     ///< nothing changed in all of it
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

  /// Before Find: reuses the blocks of an earlier contour of the whole, on the same lattice and with the same options,
  /// that the change since then does not reach.
  void TakeOver(std::vector<Region> before, const FieldChange& change);

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

  /// Appends the regions of the earlier contour in a range, in which nothing changed.
  void TakeRegions(const CellRange& range);

  /// Appends the blocks of a region's earlier contour in a range, in which nothing changed.
  void TakeBlocks(const CellRange& range, Region& region) const;

  /// Whether a box of cells touches a region of this piece such that this needs vertices of it.
  bool IsBesideOwn(const LatticeIndex& low, int size) const;

  void FindBlocks(const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe);

  void RunRegion(Region& region, const Progress& progress, double fraction) const;

  const ContourOptions Options;
  const CrossingOptions Crossing;
  std::unordered_set<std::uint64_t> OwnRegions; ///< of this piece, when it is not the whole
  const FieldChange* Change = nullptr;          ///< since the earlier contour; null: there is none
  std::unordered_map<std::uint64_t, Region> Before; ///< its regions by their first cells
};

}

#endif
