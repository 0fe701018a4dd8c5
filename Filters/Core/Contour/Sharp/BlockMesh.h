// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BlockMesh_h
#define freespace_BlockMesh_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourOctree.h"
#include "Contour/Lattice/MarchingCubesCases.h"
#include "Contour/Sharp/BlockPlace.h"
#include "Contour/Sharp/SharpFeature.h"

#include <unordered_map>

namespace freespace
{

/// The blocks of a contour as one mesh: finds blocks, cells, and the vertices on lattice edges,
/// also across blocks, and decides which cells' sharp vertices are joined.
class BlockMesh
{
public:
  explicit BlockMesh(const ContourLattice& wholeLattice)
    : lattice(wholeLattice)
  {
  }

  /// Adds the blocks of all regions, by reference.
  void Add(const std::vector<Region>& regions);

  /// The least distance of sharp vertices to the sides of their cells, and twice that of new edges
  /// to the sides of the faces, in cells.
  static constexpr double SharpClearance = 0.01;

  /// The distance within which the field must confirm an edge or corner of the planes, in cells.
  static constexpr double FeatureReach = 0.05;

  /// The greatest distance of a sharp vertex to the surface, in cells: allows for roughness that
  /// the smoothed normals leave out, but not for another surface.
  static constexpr double VertexSlack = 0.5;

  /// The index of no vertex.
  static constexpr std::size_t Missing = static_cast<std::size_t>(-1);

  /// The first region of a layer, and the first place of its blocks.
  struct Layer
  {
    std::size_t region, place;
  };

  /// Calls work(place) for all places, in parallel, and reports the progress in between.
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

  /// The first point of an edge of a cell.
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

  /// The faces of the c-th cell across which matter is joined, a bit for each.
  static int JoinedFacesOf(const BlockPlace& place, std::size_t c)
  {
    const auto joined = std::lower_bound(place.joined.begin(), place.joined.end(), c,
      [](const JoinedFaces& a, std::size_t cell) { return a.cell < cell; });
    return joined != place.joined.end() && joined->cell == c ? joined->faces : 0;
  }

  /// The loops of the surface on the faces of the c-th cell of a block.
  static const std::vector<MarchingCubesCases::Loop>& LoopsOf(
    const BlockPlace& place, std::size_t c)
  {
    return MarchingCubesCases::Get().Loops(place.block->cases[c], JoinedFacesOf(place, c));
  }

  /// The vertex on the lattice edge that begins at a point of a block.
  static std::size_t VertexAt(const ContourBlock& block, const LatticeIndex& point, int axis)
  {
    const auto& keys = block.keys;
    const auto key = std::lower_bound(keys.begin(), keys.end(), ContourBlock::Key(point, axis));
    return key != keys.end() && *key == ContourBlock::Key(point, axis) ? key - keys.begin()
                                                                       : Missing;
  }

  /// The data of a sharp vertex.
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

  /// The scope of the field where the sharp vertices of a block can lie.
  FieldScope ScopeAround(const BoundedField& field, const ContourBlock& block) const;

  /// The block that a cell or point of the lattice belongs to; null: the surface is not near.
  /// Changes the index to one relative to the block.
  const BlockPlace* PlaceOf(LatticeIndex& index) const;

  /// The block at a place in units of blocks; null: the surface is not near.
  BlockPlace* FindPlace(const LatticeIndex& at) const;

  /// Finds a cell of the lattice in its block. False where the surface does not pass.
  bool FindCell(LatticeIndex cell, const BlockPlace*& place, std::size_t& c) const;

  /// The case of a cell of the lattice; 0 where the surface does not pass.
  int CaseOf(const LatticeIndex& cell) const;

  /// The blocks above a block; null where not looked up yet.
  using Neighbors = std::array<BlockPlace*, 8>;

  /// The vertex on a cube edge of a cell.
  bool FindCorner(const BlockPlace& place, const LatticeIndex& cell, int edge, Neighbors& neighbors,
    BlockVertex& corner) const;

  /// The vertex on a lattice edge, in the block that owns it.
  std::size_t FindVertex(
    const BlockPlace& from, LatticeIndex point, int axis, BlockPlace*& owner) const;

  /// The plane of the surface at a vertex that lies on a lattice edge.
  SurfacePlane PlaneAt(const BlockVertex& vertex) const;

  /// Adds the tangent planes at the crossings of a cell of the lattice. False when the cell has
  /// more than one sheet.
  bool CollectPlanes(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const;

  /// The sharp vertex of a cell of the block or next to it.
  bool FindSharp(const BlockPlace& from, LatticeIndex cell, BlockVertex& found) const;

  /// The face of a sharp vertex's cell, beyond which there is another one.
  /// False when there is no other sharp vertex, or more than one line crosses the face.
  bool FindSharpFace(
    const BlockPlace& place, std::size_t sharp, int face, SharpFace& sharpFace) const;

  /// Whether an edge between two sharp vertices passes through the face between their cells, off
  /// its border: then the new triangles stay within the two cells, where nothing else is on that
  /// face.
  bool IsThroughFace(
    const Eigen::Vector3d& own, const Eigen::Vector3d& other, const SharpFace& face) const;

  /// Two triangles meet on the face between two cells with sharp vertices s and t: (s, u, v) and
  /// (t, v, u). To join s and t by an edge (an edge flip), they become (s, u, t) and (t, v, s): the
  /// last corner of each changes. Both cells get the same result.
  void JoinSharp(const BlockPlace& place, std::size_t sharp, int face, BlockVertex& last) const;

  /// Calls visit(triangle, its three corners, whether it is in the fan around a sharp vertex, the
  /// face of its two last corners) for all triangles of a block. In a fan, the sharp vertex is the
  /// first corner. False when a vertex is missing.
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
  std::vector<Layer> layers; ///< and one more, for the end

private:
  static constexpr std::size_t PlacesAtATime = 2048; ///< between two reports of the progress

  std::unordered_map<std::uint64_t, std::size_t> Index; ///< of places, by their blocks' indices
};

}

#endif
