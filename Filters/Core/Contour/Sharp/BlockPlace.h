// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BlockPlace_h
#define freespace_BlockPlace_h

#include "Contour/Lattice/ContourBlock.h"
#include "Contour/Sharp/SharpFeature.h"

#include <cstdint>
#include <vector>

namespace freespace
{

/// The cell that contains a sharp vertex: its own, an adjacent one without the surface, or an
/// adjacent one with it, where its triangles may intersect others.
enum class Reach
{
  Own,
  Empty,
  Surface
};

/// A vertex of a cell, around which the cell's triangles form a fan.
struct SharpVertex
{
  std::size_t cell; ///< index in the block's cells
  Eigen::Vector3d position;
  Eigen::Vector3d fallback; ///< position within the cell
  Eigen::Vector3d edge;     ///< of a corner: its position if it is not used
  Reach edgeReach;
  bool isCorner;
  bool isBorrowed; ///< from a plane of another cell
  Reach reach;
};

/// A sharp feature of the planes of one cell that lies in another one.
struct SharpOffer
{
  LatticeIndex cell; ///< of the lattice; in a block's own list, of the block
  SharpFeature feature;
};

/// The faces of a cell on which two opposite corners in matter are joined.
struct JoinedFaces
{
  std::size_t cell; ///< place in the block's cells
  int faces;        ///< one bit for each
};

/// A face of a cell, across which its sharp vertex is joined to that of the adjacent cell by an
/// edge that does not pass through the face.
struct FaceLink
{
  std::size_t cell; ///< place in the block's cells
  int face;
};

/// A block in the mesh, its first vertex and triangle there, and its sharp vertices. The vertices
/// are those of the block, then the sharp ones.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<JoinedFaces> joined; ///< in the order of their cells
  std::vector<SharpVertex> sharp;  ///< in the order of their cells
  std::vector<FaceLink> links;
  std::vector<SharpOffer> offers;   ///< to any block's cells
  std::vector<SharpOffer> received; ///< to the block's cells
  std::vector<std::int32_t> vertex; ///< of another piece's block: index in the mesh, or -1

  std::size_t NumberOfVertices() const { return this->block->keys.size() + this->sharp.size(); }
};

/// A vertex: its block, and its index there.
struct BlockVertex
{
  BlockPlace* owner;
  std::size_t vertex;
};

/// A face between two cells with a sharp vertex each.
struct SharpFace
{
  BlockVertex other;
  bool isUpper; ///< of the cell
  int axis;
  Eigen::Vector3d low; ///< the face's first corner
};

}

#endif
