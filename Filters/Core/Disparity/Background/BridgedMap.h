// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BridgedMap_h
#define freespace_BridgedMap_h

#include "Common/GroupedLists.h"
#include "Disparity/Background/BackgroundContinuation.h"
#include "ViewFreespace/ViewFreespace.h"

#include <vector>

namespace freespace
{

/// A disparity map, of which is known which triangles are bridges.
struct BridgedMap
{
  /// Keeps a reference to the map. Throws Aborted soon after the flag is set.
  BridgedMap(
    const DisparityMap& map, const BackgroundOptions& options, const CancellationFlag& stop);

  const DisparityMap& map;
  ViewFreespace freespace;
  std::vector<double> disparity; ///< per point
  std::vector<char> isBridge;    ///< per triangle
  GroupedLists<int> sound;       ///< per point, its triangles that are not bridges

private:
  bool Spans(std::size_t triangle, const BackgroundOptions& options) const;
};

/// The parts of the image that bridges touch: rejects most points at the cost of a projection.
class BridgeMask
{
public:
  explicit BridgeMask(const BridgedMap& bridged);

  bool MayHold(const Eigen::Vector2d& pixel) const
  {
    return this->Box.contains(pixel) && this->Touched[Index(this->Tile(pixel))];
  }

private:
  static constexpr int Tiles = 512; ///< along each side

  Eigen::Array2i Tile(const Eigen::Vector2d& pixel) const
  {
    return ((pixel - this->Box.min()).array() * this->TilesPerPixel).cast<int>().min(Tiles - 1);
  }
  static int Index(const Eigen::Array2i& tile) { return tile.y() * Tiles + tile.x(); }

  Eigen::AlignedBox2d Box;
  Eigen::Array2d TilesPerPixel;
  std::vector<char> Touched;
};

}

#endif
