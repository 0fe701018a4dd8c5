// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BlockMesh_h
#define freespace_BlockMesh_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourOctree.h"
#include "Contour/Lattice/MarchingCubesCases.h"
#include "Contour/Sharp/SharpFeature.h"

#include <unordered_map>

namespace freespace
{

/// Which cell a sharp vertex lies in: its own, or one beside it, where triangles may be in the way.
enum class Reach
{
  Own,
  Empty,
  Surface
};

/// A vertex of a cell, about which the cell's triangles are a fan.
struct SharpVertex
{
  std::size_t cell; ///< place in the block's cells
  Eigen::Vector3d position;
  Eigen::Vector3d fallback; ///< within the cell
  Eigen::Vector3d edge;     ///< of a corner: where it would be otherwise
  Reach edgeReach;
  bool isCorner;
  bool isBorrowed; ///< from a plane of another cell
  Reach reach;
};

/// A sharp feature that the planes of a cell show in another one.
struct SharpOffer
{
  LatticeIndex cell; ///< of the lattice; in a block's own list, of the block
  SharpFeature feature;
};

/// A cell's faces on which two corners in matter, opposite to each other, hang together.
struct JoinedFaces
{
  std::size_t cell; ///< place in the block's cells
  int faces;        ///< one bit for each
};

/// A face of a cell, over which its sharp vertex is joined to the next cell's, though not through it.
struct Bridge
{
  std::size_t cell; ///< place in the block's cells
  int face;
};

/// Where a block's vertices and triangles come in the mesh. The vertices are those of the block, then
/// the sharp ones.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<JoinedFaces> joined; ///< in the order of their cells
  std::vector<SharpVertex> sharp;  ///< in the order of their cells
  std::vector<Bridge> bridges;
  std::vector<SharpOffer> offers;   ///< to any block's cells
  std::vector<SharpOffer> received; ///< to the block's cells
  std::vector<std::int32_t> vertex; ///< of another piece's block: place in the mesh, or -1

  std::size_t NumberOfVertices() const { return this->block->keys.size() + this->sharp.size(); }
};

/// A vertex: of which block, and its place in it.
struct BlockVertex
{
  BlockPlace* owner;
  std::size_t vertex;
};

/// A face of a cell with a sharp vertex, beyond which there is another one.
struct SharpFace
{
  BlockVertex other;
  bool isUpper; ///< of the cell
  int axis;
  Eigen::Vector3d low; ///< the face's first corner
};

/// The blocks of a contour and what they share: which stands where, which vertex lies on a lattice edge
/// and which cells' sharp vertices are joined.
class BlockMesh
{
public:
  explicit BlockMesh(const ContourLattice& wholeLattice)
    : lattice(wholeLattice)
  {
  }

  /// Takes the blocks of all regions, which stay where they are.
  void Add(const std::vector<Region>& regions);

  /// Sharp vertices keep so far from the sides of their cells, and new edges half as far from those of
  /// the faces, in cells.
  static constexpr double SharpClearance = 0.01;

  /// The field must show an edge or corner so close to where the planes say that it is, in cells.
  static constexpr double FeatureReach = 0.05;

  /// A sharp vertex may be so far off the surface, in cells: roughness that the smoothed normals leave
  /// out, but no other surface.
  static constexpr double VertexSlack = 0.5;

  /// No vertex.
  static constexpr std::size_t Missing = static_cast<std::size_t>(-1);

  /// Regions of one layer: where they, and their blocks, begin.
  struct Layer
  {
    std::size_t region, place;
  };

  /// Calls work(place) for all places, in parallel, with looks at the progress in between.
  template <typename Work>
  void ForEachPlace(const Progress& progress, const ParallelFor& parallelFor, Work&& work,
    const std::function<void(std::size_t layer)>& afterLayer = {}) const
  {
    const std::size_t count = this->places.size();
    for (std::size_t layer = 0; layer + 1 < this->layers.size(); ++layer)
    {
      const std::size_t end = this->layers[layer + 1].place;
      for (std::size_t first = this->layers[layer].place; first < end; first += PlacesAtATime)
      {
        progress(static_cast<double>(first) / count);
        parallelFor(std::min(PlacesAtATime, end - first),
          [&](std::size_t from, std::size_t to)
          {
            for (std::size_t i = first + from; i < first + to; ++i)
            {
              work(i);
            }
          });
      }
      if (afterLayer)
      {
        afterLayer(layer);
      }
    }
  }

  /// The cell of a block with a key.
  static LatticeIndex CellOf(int cell)
  {
    const int size = ContourBlock::Size;
    return { cell % size, cell / size % size, cell / (size * size) };
  }

  /// Where an edge of a cell begins.
  static LatticeIndex FirstPoint(const LatticeIndex& cell, int edge)
  {
    const int begin = MarchingCubesCases::Begin(edge);
    return { cell[0] + (begin & 1), cell[1] + (begin >> 1 & 1), cell[2] + (begin >> 2 & 1) };
  }

  /// One of the 27 cells around and at a cell, n in [0, 27).
  static LatticeIndex Beside(const LatticeIndex& cell, int n)
  {
    return { cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1 };
  }

  /// The faces of the c-th cell over which its matter hangs together, a bit for each.
  static int JoinedFacesOf(const BlockPlace& place, std::size_t c)
  {
    const auto joined = std::lower_bound(place.joined.begin(), place.joined.end(), c,
      [](const JoinedFaces& a, std::size_t cell) { return a.cell < cell; });
    return joined != place.joined.end() && joined->cell == c ? joined->faces : 0;
  }

  /// The lines in which the surface crosses the faces of the c-th cell of a block.
  static const std::vector<MarchingCubesCases::Loop>& LoopsOf(const BlockPlace& place, std::size_t c)
  {
    return MarchingCubesCases::Get().Loops(place.block->cases[c], JoinedFacesOf(place, c));
  }

  /// The vertex on the lattice edge from a point of a block.
  static std::size_t VertexAt(const ContourBlock& block, const LatticeIndex& point, int axis)
  {
    const auto& keys = block.keys;
    const auto key = std::lower_bound(keys.begin(), keys.end(), ContourBlock::Key(point, axis));
    return key != keys.end() && *key == ContourBlock::Key(point, axis) ? key - keys.begin()
                                                                       : Missing;
  }

  /// The sharp vertex that a vertex is.
  static SharpVertex& SharpOf(const BlockVertex& vertex)
  {
    return vertex.owner->sharp[vertex.vertex - vertex.owner->block->keys.size()];
  }

  /// The c-th cell of a block in the lattice.
  LatticeIndex LatticeCell(const ContourBlock& block, std::size_t c) const;

  /// The first corner of a cell of a block.
  Eigen::Vector3d CellCorner(const ContourBlock& block, const LatticeIndex& cell) const;

  /// A cell of the lattice with (positive) or without (negative) a rim, in cells.
  Eigen::AlignedBox3d CellBox(const LatticeIndex& cell, double rim) const;

  /// The block that a cell or point of the lattice belongs to; null: the surface is not near. Makes
  /// the index one in the block.
  const BlockPlace* PlaceOf(LatticeIndex& index) const;

  /// The block at a place in units of blocks; null: the surface is not near.
  BlockPlace* FindPlace(const LatticeIndex& at) const;

  /// Finds a cell of the lattice in its block. False where the surface does not pass.
  bool FindCell(LatticeIndex cell, const BlockPlace*& place, std::size_t& c) const;

  /// The case of a cell of the lattice; 0 where the surface does not pass.
  int CaseOf(const LatticeIndex& cell) const;

  /// The blocks above a block, as far as they were looked for.
  using Neighbors = std::array<BlockPlace*, 8>;

  /// The vertex on a cube edge of a cell.
  bool FindCorner(const BlockPlace& place, const LatticeIndex& cell, int edge, Neighbors& neighbors,
    BlockVertex& corner) const;

  /// The vertex on a lattice edge, in the block that owns it.
  std::size_t FindVertex(
    const BlockPlace& from, LatticeIndex point, int axis, BlockPlace*& owner) const;

  /// The plane of the surface at a vertex that lies on a lattice edge.
  SurfacePlane PlaneAt(const BlockVertex& vertex) const;

  /// The planes of the surface in a cell of the lattice. False when they are not of one sheet.
  bool CollectPlanes(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const;

  /// The sharp vertex of a cell of the block or next to it.
  bool FindSharp(const BlockPlace& from, LatticeIndex cell, BlockVertex& found) const;

  /// The face of a sharp vertex's cell, beyond which there is another one.
  /// False when there is no other sharp vertex, or more than one line crosses the face.
  bool FindSharpFace(
    const BlockPlace& place, std::size_t sharp, int face, SharpFace& sharpFace) const;

  /// Whether an edge between two sharp vertices passes through the face between their cells, off its
  /// border: then the new triangles stay within the two cells, where nothing else is on that face.
  bool IsThroughFace(
    const Eigen::Vector3d& own, const Eigen::Vector3d& other, const SharpFace& face) const;

  /// Two triangles meet on the face between two cells with sharp vertices s and t: (s, u, v) and
  /// (t, v, u). To join s and t by an edge, instead of the one that parts them, they become (s, u, t)
  /// and (t, v, s): the last corner of each changes. Both cells decide alike.
  void JoinSharp(const BlockPlace& place, std::size_t sharp, int face, BlockVertex& last) const;

  /// Calls visit(triangle, its three corners, whether it is in the fan about a sharp vertex, the face
  /// that its two last corners share) for all triangles of a block. In a fan, the sharp vertex is the
  /// first corner. False when a vertex is not there.
  template <typename Visit>
  bool ForEachTriangle(const BlockPlace& place, Visit&& visit) const
  {
    const ContourBlock& block = *place.block;
    std::size_t triangle = 0, sharp = 0;
    bool whole = true;
    Neighbors neighbors = {};
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const LatticeIndex cell = CellOf(block.cells[c]);
      const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
      for (const MarchingCubesCases::Loop& loop : LoopsOf(place, c))
      {
        const std::size_t size = loop.size();
        for (std::size_t n = isSharp ? 0 : 2; n < size; ++n, ++triangle)
        {
          const int from = loop[n > 0 ? n - 1 : size - 1], to = loop[n];
          std::array<BlockVertex, 3> corners;
          if (isSharp)
          {
            corners[0] = { const_cast<BlockPlace*>(&place), block.keys.size() + sharp };
          }
          if ((!isSharp && !this->FindCorner(place, cell, loop[0], neighbors, corners[0])) ||
            !this->FindCorner(place, cell, from, neighbors, corners[1]) ||
            !this->FindCorner(place, cell, to, neighbors, corners[2]))
          {
            whole = false;
            continue;
          }
          if (isSharp)
          {
            this->JoinSharp(place, sharp, MarchingCubesCases::CommonFace(from, to), corners[2]);
          }
          visit(triangle, corners, isSharp, MarchingCubesCases::CommonFace(from, to));
        }
      }
      sharp += isSharp;
    }
    return whole;
  }

  const ContourLattice& lattice;
  std::vector<BlockPlace> places;
  std::vector<Layer> layers; ///< and one more, the end

private:
  static constexpr std::size_t PlacesAtATime = 2048; ///< between two looks at the progress

  std::unordered_map<std::uint64_t, std::size_t> Index; ///< of places, by where their blocks are
};

}

#endif
