// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/SharpVertexJoiner.h"

#include "Mesh/TriangleIntersections.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

class SharpVertexJoiner
{
public:
  SharpVertexJoiner(BlockMesh& blocks, bool isSingle)
    : Blocks(blocks)
    , IsSingle(isSingle)
  {
  }

  /// Moves vertices that are outside of their cells back, unless their fans intersect nothing.
  void MoveMeetingVerticesBack(const Progress& progress, const ParallelFor& parallelFor);

  /// Joins sharp vertices also by edges that do not pass through the face between their cells,
  /// where the edge is on the surface and the new triangles intersect nothing.
  void FindFaceLinks(const Progress& progress, const ParallelFor& parallelFor);

private:
  /// Triangles that the mesh may have near some choices; each exists if its conditions hold.
  struct Candidates
  {
    static constexpr int Always = -1;
    static int If(int choice) { return 2 * choice + 1; }
    static int IfNot(int choice) { return 2 * choice; }

    std::vector<std::int32_t> triangles;
    std::vector<std::array<int, 2>> conditions; ///< per triangle
    std::vector<Vector3d> points;
    /// The same in memory, as GCC 12 omits a conversion to single precision and back.
    std::vector<Eigen::Vector3f> rounded;
    std::unordered_map<std::uint64_t, std::int32_t> ids;
  };

  /// A candidate position of a sharp vertex.
  struct MaybeVertex
  {
    BlockVertex vertex;
    Vector3d position;
    bool isOwn; ///< in its own cell
    int condition;
  };

  /// A vertex or link to choose. Of two that exclude each other, the one of greater rank is
  /// dropped.
  struct Choice
  {
    BlockVertex vertex;
    int face; ///< of a link
    std::array<double, 4> rank;
    bool isLost;
  };

  /// The choices by the keys of their vertices and links.
  using ChoiceIndex = std::unordered_map<std::uint64_t, int>;

  void FindLostChoices(std::vector<Choice>& choices, const ChoiceIndex& index,
    const Progress& progress, const ParallelFor& parallelFor) const;
  static bool AreCompatible(const std::array<int, 2>& a, const std::array<int, 2>& b);
  bool IsInLayer(const BlockVertex& vertex, std::size_t layer) const;
  std::set<std::size_t> PlacesAround(const std::vector<Choice>& choices, std::size_t layer) const;
  std::array<double, 4> RankOf(const BlockVertex& vertex, double first) const;
  /// Calls visit(vertex) for all sharp vertices.
  template <typename Visit>
  void ForEachSharpVertex(Visit&& visit)
  {
    for (BlockPlace& place : this->Blocks.places)
    {
      for (std::size_t i = 0; i < place.sharp.size(); ++i)
      {
        visit(BlockVertex{ &place, place.block->keys.size() + i });
      }
    }
  }

  void AddCandidates(
    const BlockPlace& place, const ChoiceIndex& choices, Candidates& candidates) const;
  void AddFanTriangle(const BlockPlace& place, std::size_t sharp, int face, const BlockVertex& u,
    const BlockVertex& v, const ChoiceIndex& choices, Candidates& candidates) const;
  std::vector<MaybeVertex> Maybe(const BlockVertex& vertex, const ChoiceIndex& choices) const;
  std::int32_t AddPoint(Candidates& candidates, std::uint64_t key, const Vector3d& position) const;
  std::int32_t AddCorner(Candidates& candidates, const BlockVertex& vertex) const;
  std::int32_t AddCorner(Candidates& candidates, const MaybeVertex& vertex) const;
  static void AddTriangle(Candidates& candidates, const std::array<std::int32_t, 3>& corners,
    int conditionA, int conditionB = Candidates::Always);
  std::uint64_t KeyOf(const BlockVertex& vertex) const;
  std::uint64_t FaceLinkKey(const BlockVertex& lower, int face) const;
  bool IsOnSurface(
    const Vector3d& s, const Vector3d& t, const BlockVertex& u, const BlockVertex& v) const;

  BlockMesh& Blocks;
  const bool IsSingle;
};

void SharpVertexJoiner::MoveMeetingVerticesBack(
  const Progress& progress, const ParallelFor& parallelFor)
{
  std::vector<Choice> choices;
  ChoiceIndex index;
  this->ForEachSharpVertex(
    [&](const BlockVertex& vertex)
    {
      const SharpVertex& sharp = BlockMesh::SharpOf(vertex);
      if (sharp.reach != Reach::Own)
      {
        const AlignedBox3d cell =
          this->Blocks.CellBox(this->Blocks.LatticeCell(*vertex.owner->block, sharp.cell), 0.0);
        const double distance =
          cell.exteriorDistance(sharp.position) / this->Blocks.lattice.spacing;
        // Vertices in a cell of the surface are moved back first, then those at a greater distance.
        const double rank = distance + (sharp.reach == Reach::Surface ? 4.0 : 0.0);
        index[this->KeyOf(vertex)] = static_cast<int>(choices.size());
        choices.push_back({ vertex, 0, this->RankOf(vertex, rank), false });
      }
    });
  this->FindLostChoices(choices, index, progress, parallelFor);
  for (const Choice& choice : choices)
  {
    if (choice.isLost)
    {
      SharpVertex& sharp = BlockMesh::SharpOf(choice.vertex);
      sharp.position = sharp.fallback;
      sharp.reach = Reach::Own;
    }
  }
}

void SharpVertexJoiner::FindFaceLinks(const Progress& progress, const ParallelFor& parallelFor)
{
  std::vector<Choice> choices;
  ChoiceIndex index;
  for (BlockPlace& place : this->Blocks.places)
  {
    if (place.sharp.empty())
    {
      continue;
    }
    this->Blocks.ForEachTriangle(place,
      [&](std::size_t, const std::array<BlockVertex, 3>& corners, bool isSharp, int face)
      {
        SharpFace sharpFace;
        const std::size_t sharp = corners[0].vertex - place.block->keys.size();
        if (!isSharp || !(face & 1) || corners[2].vertex >= corners[2].owner->block->keys.size() ||
          !this->Blocks.FindSharpFace(place, sharp, face, sharpFace) ||
          !this->IsOnSurface(BlockMesh::SharpOf(corners[0]).position,
            BlockMesh::SharpOf(sharpFace.other).position, corners[1], corners[2]))
        {
          return;
        }
        index[this->FaceLinkKey(corners[0], face)] = static_cast<int>(choices.size());
        choices.push_back({ corners[0], face, this->RankOf(corners[0], face), false });
      });
  }
  this->FindLostChoices(choices, index, progress, parallelFor);
  for (const Choice& choice : choices)
  {
    SharpFace sharpFace;
    const std::size_t sharp = choice.vertex.vertex - choice.vertex.owner->block->keys.size();
    if (!choice.isLost &&
      this->Blocks.FindSharpFace(*choice.vertex.owner, sharp, choice.face, sharpFace))
    {
      choice.vertex.owner->links.push_back({ BlockMesh::SharpOf(choice.vertex).cell, choice.face });
      sharpFace.other.owner->links.push_back(
        { BlockMesh::SharpOf(sharpFace.other).cell, choice.face ^ 1 });
    }
  }
}

// Finds the choices that cannot be made: where two compatible candidate triangles intersect, the
// choice of the greatest rank among their conditions is lost. All remaining choices can then be
// made together, and each depends only on its surroundings.
void SharpVertexJoiner::FindLostChoices(std::vector<Choice>& choices, const ChoiceIndex& index,
  const Progress& progress, const ParallelFor& parallelFor) const
{
  for (std::size_t layer = 0; layer + 1 < this->Blocks.layers.size(); ++layer)
  {
    progress(static_cast<double>(layer) / this->Blocks.layers.size());
    const std::set<std::size_t> places = this->PlacesAround(choices, layer);
    Candidates candidates;
    for (std::size_t place : places)
    {
      this->AddCandidates(this->Blocks.places[place], index, candidates);
    }
    std::vector<std::size_t> suspects;
    for (std::size_t t = 0; t < candidates.conditions.size(); ++t)
    {
      for (int condition : candidates.conditions[t])
      {
        if (condition >= 0 && condition % 2 == 1 &&
          this->IsInLayer(choices[condition / 2].vertex, layer) &&
          (suspects.empty() || suspects.back() != t))
        {
          suspects.push_back(t);
        }
      }
    }
    const auto position = [&](std::int32_t vertex) -> Vector3d
    {
      return this->IsSingle ? Vector3d(candidates.rounded[vertex].cast<double>())
                            : candidates.points[vertex];
    };
    const TriangleSoup soup = { position, candidates.triangles.data(),
      candidates.conditions.size() };
    const auto mayMeet = [&](std::size_t a, std::size_t b)
    { return AreCompatible(candidates.conditions[a], candidates.conditions[b]); };
    for (const auto& [a, b] :
      FindIntersections(soup, suspects, this->Blocks.lattice.spacing, mayMeet, parallelFor))
    {
      Choice* loser = nullptr;
      for (std::size_t t : { a, b })
      {
        for (int condition : candidates.conditions[t])
        {
          Choice* choice = condition >= 0 && condition % 2 == 1 ? &choices[condition / 2] : nullptr;
          loser = choice && (!loser || loser->rank < choice->rank) ? choice : loser;
        }
      }
      if (this->IsInLayer(loser->vertex, layer))
      {
        loser->isLost = true;
      }
    }
  }
  progress(1.0);
}

bool SharpVertexJoiner::AreCompatible(const std::array<int, 2>& a, const std::array<int, 2>& b)
{
  for (int conditionA : a)
  {
    for (int conditionB : b)
    {
      if (conditionA >= 0 && conditionB >= 0 && (conditionA ^ 1) == conditionB)
      {
        return false;
      }
    }
  }
  return true;
}

bool SharpVertexJoiner::IsInLayer(const BlockVertex& vertex, std::size_t layer) const
{
  const std::size_t place = vertex.owner - this->Blocks.places.data();
  return place >= this->Blocks.layers[layer].place && place < this->Blocks.layers[layer + 1].place;
}

// The blocks within a few cells of the choices of a layer.
std::set<std::size_t> SharpVertexJoiner::PlacesAround(
  const std::vector<Choice>& choices, std::size_t layer) const
{
  std::set<std::size_t> places;
  for (const Choice& choice : choices)
  {
    if (!this->IsInLayer(choice.vertex, layer))
    {
      continue;
    }
    const LatticeIndex cell =
      this->Blocks.LatticeCell(*choice.vertex.owner->block, BlockMesh::SharpOf(choice.vertex).cell);
    for (int n = 0; n < 8; ++n)
    {
      LatticeIndex at;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int around =
          cell[axis] + ((n >> axis & 1) ? ContourBlock::Size / 2 : -ContourBlock::Size / 2);
        at[axis] = around < 0 ? -1 : around / ContourBlock::Size;
      }
      const BlockPlace* place =
        std::min({ at[0], at[1], at[2] }) < 0 ? nullptr : this->Blocks.FindPlace(at);
      if (place)
      {
        places.insert(place - this->Blocks.places.data());
      }
    }
  }
  return places;
}

std::array<double, 4> SharpVertexJoiner::RankOf(const BlockVertex& vertex, double first) const
{
  const LatticeIndex cell =
    this->Blocks.LatticeCell(*vertex.owner->block, BlockMesh::SharpOf(vertex).cell);
  return { first, double(cell[0]), double(cell[1]), double(cell[2]) };
}

// Adds a block's triangles. The choices are vertices outside of their cells, or (with the face
// added to their key) links.
void SharpVertexJoiner::AddCandidates(
  const BlockPlace& place, const ChoiceIndex& choices, Candidates& candidates) const
{
  std::size_t sharp = 0;
  BlockMesh::Neighbors neighbors = {};
  for (std::size_t c = 0; c < place.block->cells.size(); ++c)
  {
    const LatticeIndex cell = BlockMesh::CellOf(place.block->cells[c]);
    const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
    for (const MarchingCubesCases::Loop& loop : BlockMesh::LoopsOf(place, c))
    {
      std::vector<BlockVertex> corners(loop.size());
      const bool isWhole = std::equal(loop.begin(), loop.end(), corners.begin(),
        [&](int edge, BlockVertex& corner)
        { return this->Blocks.FindCorner(place, cell, edge, neighbors, corner); });
      for (std::size_t n = isSharp ? 0 : 2; n < loop.size() && isWhole; ++n)
      {
        const std::size_t from = n > 0 ? n - 1 : loop.size() - 1;
        if (isSharp)
        {
          const int face = MarchingCubesCases::CommonFace(loop[from], loop[n]);
          this->AddFanTriangle(place, sharp, face, corners[from], corners[n], choices, candidates);
        }
        else
        {
          AddTriangle(candidates,
            { this->AddCorner(candidates, corners[0]), this->AddCorner(candidates, corners[from]),
              this->AddCorner(candidates, corners[n]) },
            Candidates::Always);
        }
      }
    }
    sharp += isSharp;
  }
}

void SharpVertexJoiner::AddFanTriangle(const BlockPlace& place, std::size_t sharp, int face,
  const BlockVertex& u, const BlockVertex& v, const ChoiceIndex& choices,
  Candidates& candidates) const
{
  const BlockVertex own = { const_cast<BlockPlace*>(&place), place.block->keys.size() + sharp };
  SharpFace sharpFace;
  const bool hasOther = this->Blocks.FindSharpFace(place, sharp, face, sharpFace);
  const std::int32_t cornerU = this->AddCorner(candidates, u);
  const std::int32_t cornerV = this->AddCorner(candidates, v);
  for (const MaybeVertex& a : this->Maybe(own, choices))
  {
    const std::int32_t cornerA = this->AddCorner(candidates, a);
    if (!hasOther)
    {
      AddTriangle(candidates, { cornerA, cornerU, cornerV }, a.condition);
      continue;
    }
    for (const MaybeVertex& b : this->Maybe(sharpFace.other, choices))
    {
      const bool isThrough =
        a.isOwn && b.isOwn && this->Blocks.IsThroughFace(a.position, b.position, sharpFace);
      const auto link =
        choices.find(this->FaceLinkKey(sharpFace.isUpper ? own : sharpFace.other, face));
      const std::int32_t cornerB = this->AddCorner(candidates, b);
      if (link != choices.end())
      {
        AddTriangle(candidates, { cornerA, cornerU, cornerV }, Candidates::IfNot(link->second));
        AddTriangle(candidates, { cornerA, cornerU, cornerB }, Candidates::If(link->second));
      }
      else
      {
        AddTriangle(candidates, { cornerA, cornerU, isThrough ? cornerB : cornerV }, a.condition,
          b.condition);
      }
    }
  }
}

// The possible positions of a sharp vertex while it is not decided which vertices are moved back.
std::vector<SharpVertexJoiner::MaybeVertex> SharpVertexJoiner::Maybe(
  const BlockVertex& vertex, const ChoiceIndex& choices) const
{
  const SharpVertex& sharp = BlockMesh::SharpOf(vertex);
  const auto choice = choices.find(this->KeyOf(vertex));
  if (choice == choices.end())
  {
    return { { vertex, sharp.position, sharp.reach == Reach::Own, Candidates::Always } };
  }
  return { { vertex, sharp.position, false, Candidates::If(choice->second) },
    { vertex, sharp.fallback, true, Candidates::IfNot(choice->second) } };
}

std::int32_t SharpVertexJoiner::AddPoint(
  Candidates& candidates, std::uint64_t key, const Vector3d& position) const
{
  const auto [place, isNew] =
    candidates.ids.emplace(key, static_cast<std::int32_t>(candidates.points.size()));
  if (isNew)
  {
    candidates.points.push_back(position);
    candidates.rounded.push_back(position.cast<float>());
  }
  return place->second;
}

std::int32_t SharpVertexJoiner::AddCorner(Candidates& candidates, const BlockVertex& vertex) const
{
  return this->AddPoint(candidates, this->KeyOf(vertex),
    vertex.owner->block->Position(this->Blocks.lattice, vertex.vertex));
}

std::int32_t SharpVertexJoiner::AddCorner(Candidates& candidates, const MaybeVertex& vertex) const
{
  const bool isBack = vertex.condition >= 0 && vertex.condition % 2 == 0;
  return this->AddPoint(candidates, this->KeyOf(vertex.vertex) + isBack, vertex.position);
}

void SharpVertexJoiner::AddTriangle(Candidates& candidates,
  const std::array<std::int32_t, 3>& corners, int conditionA, int conditionB)
{
  candidates.triangles.insert(candidates.triangles.end(), corners.begin(), corners.end());
  candidates.conditions.push_back({ conditionA, conditionB });
}

std::uint64_t SharpVertexJoiner::KeyOf(const BlockVertex& vertex) const
{
  return static_cast<std::uint64_t>(vertex.owner - this->Blocks.places.data()) << 16 |
    static_cast<std::uint64_t>(vertex.vertex) << 1;
}

// The key of the link over the upper face of a sharp vertex's cell along the face's axis.
std::uint64_t SharpVertexJoiner::FaceLinkKey(const BlockVertex& lower, int face) const
{
  return this->KeyOf(lower) | static_cast<std::uint64_t>(1 + (face >> 1)) << 60;
}

// Whether an edge between two sharp vertices s and t, instead of the one from u to v, is close to
// the planes at u and v, and the triangles (s, u, t) and (t, v, s) face their free sides.
bool SharpVertexJoiner::IsOnSurface(
  const Vector3d& s, const Vector3d& t, const BlockVertex& u, const BlockVertex& v) const
{
  const double reach = BlockMesh::VertexSlack * this->Blocks.lattice.spacing;
  const auto isIn = [&](const SurfacePlane& plane, double side)
  {
    const Vector3d turned = side * (t - s).cross(plane.point - s);
    return std::abs(plane.normal.dot(s - plane.point)) <= reach &&
      std::abs(plane.normal.dot(t - plane.point)) <= reach && turned.dot(plane.normal) > 0;
  };
  return isIn(this->Blocks.PlaneAt(u), -1.0) && isIn(this->Blocks.PlaneAt(v), 1.0);
}

}

void JoinSharpVertices(
  bool isSingle, BlockMesh& blocks, const Progress& progress, const ParallelFor& parallelFor)
{
  SharpVertexJoiner joiner(blocks, isSingle);
  joiner.MoveMeetingVerticesBack(progress.Part(0.0, 0.5), parallelFor);
  joiner.FindFaceLinks(progress.Part(0.5, 1.0), parallelFor);
}

}
