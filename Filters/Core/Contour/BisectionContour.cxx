// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/BisectionContour.h"

#include "Common/Error.h"
#include "Contour/Sharp/BlockMesh.h"
#include "Contour/Sharp/SharpVertexFinder.h"
#include "Contour/Sharp/SharpVertexJoiner.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

/// Returns unused pages to the system, where the C library does not do so by itself, before the mesh
/// grows.
void ReturnFreeMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
class Contour
{
public:
  Contour(const ContourField& field, const AlignedBox3d& bounds, const ContourOptions& options)
    : Options(options)
    , Parts(field, bounds, options)
    , Blocks(this->Parts.lattice)
  {
  }

  /// Before Run: takes blocks of an earlier contour over. After it, they are all there for the next one.
  void TakeOver(std::vector<Region> before, const FieldChange& change)
  {
    this->Parts.TakeOver(std::move(before), change);
  }
  void KeepBlocks() { this->AreBlocksKept = true; }
  std::vector<Region> TakeRegions() { return std::move(this->Parts.regions); }

  void Run(const AllocateContour& allocate, const Progress& progress,
    const ParallelFor& parallelFor, bool isThreadSafe)
  {
    const ParallelFor& askingFor = isThreadSafe ? parallelFor : SerialFor;
    this->Parts.Find(progress.Part(0.0, 0.8), askingFor, isThreadSafe);
    this->Blocks.Add(this->Parts.regions);
    if (this->Options.sharp)
    {
      FindSharpEdges(this->Parts.field, this->Options.sharpAngle, this->Blocks,
        progress.Part(0.8, 0.86), askingFor);
      JoinSharpVertices(this->Parts.isSingle, this->Blocks, progress.Part(0.86, 0.9), askingFor);
    }
    this->Count();
    const ContourArrays arrays = allocate({ this->Vertices, this->OwnVertices, this->Triangles });
    this->Write(arrays, progress.Part(0.9, 1.0), parallelFor);
    progress(1.0);
  }

private:
  /// Gives the blocks their places in the mesh.
  void Count()
  {
    for (BlockPlace& place : this->Blocks.places)
    {
      place.firstVertex = static_cast<std::int32_t>(this->Vertices);
      place.firstTriangle = this->Triangles;
      if (place.isOwn)
      {
        // A fan around an additional vertex has two more triangles.
        this->Vertices += place.NumberOfVertices();
        this->Triangles += place.block->NumberOfTriangles() + 2 * place.sharp.size();
        for (const JoinedFaces& joined : place.joined)
        {
          const int matter = place.block->cases[joined.cell];
          this->Triangles += MarchingCubesCases::Get().NumberOfTriangles(matter, joined.faces) -
            MarchingCubesCases::Get().NumberOfTriangles(matter);
        }
      }
      this->CheckSize();
    }
    this->OwnVertices = this->Vertices;
    for (std::size_t i = 0; i < this->Blocks.places.size() && this->Options.pieces > 1; ++i)
    {
      this->CountForeign(this->Blocks.places[i]);
    }
  }

  void CheckSize() const
  {
    if (this->Vertices > INT32_MAX || 3 * this->Triangles > INT32_MAX)
    {
      throw Error("The surface has more than 2^31 corners, use fewer cells or more pieces.");
    }
  }

  /// Gives the vertices of other pieces that a block's triangles use their places.
  void CountForeign(const BlockPlace& own)
  {
    if (!own.isOwn)
    {
      return;
    }
    this->Blocks.ForEachTriangle(own,
      [&](std::size_t, const std::array<BlockVertex, 3>& corners, bool, int)
      {
        for (const BlockVertex& corner : corners)
        {
          BlockPlace& owner = *corner.owner;
          if (!owner.isOwn)
          {
            owner.vertex.resize(owner.NumberOfVertices(), -1);
            if (owner.vertex[corner.vertex] < 0)
            {
              owner.vertex[corner.vertex] = static_cast<std::int32_t>(this->Vertices++);
              this->CheckSize();
            }
          }
        }
      });
  }

  /// Writes the mesh layer by layer, and releases the data that no later layer needs.
  void Write(const ContourArrays& arrays, const Progress& progress, const ParallelFor& parallelFor)
  {
    std::atomic<bool> torn(false);
    this->Blocks.ForEachPlace(
      progress, parallelFor,
      [&](std::size_t i)
      {
        this->WritePoints(this->Blocks.places[i], arrays);
        if (this->Blocks.places[i].isOwn && !this->WriteTriangles(this->Blocks.places[i], arrays))
        {
          torn = true;
        }
      },
      [this](std::size_t layer)
      {
        if (layer > 0)
        {
          this->ReleaseLayer(layer - 1);
        }
      });
    if (torn)
    {
      throw Error("The function gave two answers for one point, so its surface cannot be closed.");
    }
  }

  void ReleaseLayer(std::size_t layer)
  {
    for (std::size_t r = this->Blocks.layers[layer].region;
         r < this->Blocks.layers[layer + 1].region && !this->AreBlocksKept; ++r)
    {
      this->Parts.regions[r].blocks = {};
    }
    for (std::size_t i = this->Blocks.layers[layer].place; i < this->Blocks.layers[layer + 1].place;
         ++i)
    {
      this->Blocks.places[i].sharp = {};
      this->Blocks.places[i].joined = {};
      this->Blocks.places[i].links = {};
      this->Blocks.places[i].vertex = {};
    }
    ReturnFreeMemory();
  }

  void WritePoints(const BlockPlace& place, const ContourArrays& arrays) const
  {
    const std::size_t count = place.block->keys.size();
    for (std::size_t v = 0; v < place.NumberOfVertices(); ++v)
    {
      const std::int32_t at = VertexPlace(place, v);
      if (at >= 0)
      {
        WritePoint(arrays, at,
          v < count ? place.block->Position(this->Blocks.lattice, v)
                    : place.sharp[v - count].position);
      }
    }
  }

  static void WritePoint(const ContourArrays& arrays, std::size_t at, const Vector3d& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (arrays.singlePoints)
      {
        arrays.singlePoints[3 * at + axis] = static_cast<float>(position[axis]);
      }
      else
      {
        arrays.doublePoints[3 * at + axis] = position[axis];
      }
    }
  }

  static std::int32_t VertexPlace(const BlockPlace& place, std::size_t vertex)
  {
    return place.isOwn       ? place.firstVertex + static_cast<std::int32_t>(vertex)
      : place.vertex.empty() ? -1
                             : place.vertex[vertex];
  }

  /// False when a vertex is not there.
  bool WriteTriangles(const BlockPlace& place, const ContourArrays& arrays) const
  {
    return this->Blocks.ForEachTriangle(place,
      [&](std::size_t t, const std::array<BlockVertex, 3>& corners, bool isSharp, int)
      {
        const std::size_t triangle = place.firstTriangle + t;
        for (int i = 0; i < 3; ++i)
        {
          arrays.triangles[3 * triangle + i] = VertexPlace(*corners[i].owner, corners[i].vertex);
        }
        if (arrays.view)
        {
          // What most of the corners are; the first where all differ. Sharp vertices are nothing.
          const BlockVertex& most =
            isSharp || AreAlike(corners[1], corners[2]) ? corners[1] : corners[0];
          arrays.view[triangle] = most.owner->block->View(most.vertex);
          arrays.kind[triangle] = most.owner->block->Kind(most.vertex);
        }
      });
  }

  static bool AreAlike(const BlockVertex& a, const BlockVertex& b)
  {
    return a.owner->block->View(a.vertex) == b.owner->block->View(b.vertex) &&
      a.owner->block->Kind(a.vertex) == b.owner->block->Kind(b.vertex);
  }

  const ContourOptions Options;
  ContourOctree Parts;
  BlockMesh Blocks;
  bool AreBlocksKept = false;
  std::size_t Vertices = 0, OwnVertices = 0, Triangles = 0;
};

/// False, with no mesh, for empty bounds. Throws Error where options or bounds are not valid.
bool IsThereLattice(const AlignedBox3d& bounds, const ContourOptions& options,
  const AllocateContour& allocate, const Progress& progress)
{
  options.Check();
  progress(0.0);
  if (bounds.isEmpty())
  {
    allocate({});
    return false;
  }
  if (!bounds.min().allFinite() || !bounds.max().allFinite() || !(bounds.sizes().maxCoeff() > 0))
  {
    throw Error("The bounds of the contour are not a finite box with an extent.");
  }
  return true;
}

}

void BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, const Progress& progress,
  const ParallelFor& parallelFor)
{
  if (IsThereLattice(bounds, options, allocate, progress))
  {
    Contour(field, bounds, options).Run(allocate, progress, parallelFor, field.IsThreadSafe());
    ReturnFreeMemory();
  }
}

void BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, KeptContour& kept,
  const FieldChange* change, const Progress& progress, const ParallelFor& parallelFor)
{
  KeptContour before;
  std::swap(before, kept);
  if (!IsThereLattice(bounds, options, allocate, progress))
  {
    return;
  }
  Contour contour(field, bounds, options);
  if (change && before.Fits(bounds, options))
  {
    contour.TakeOver(std::move(before.regions), *change);
  }
  before = {};
  contour.KeepBlocks();
  contour.Run(allocate, progress, parallelFor, field.IsThreadSafe());
  if (options.pieces == 1)
  {
    kept = { bounds, options, contour.TakeRegions() };
  }
}

ContourMesh BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress, const ParallelFor& parallelFor)
{
  ContourMesh mesh;
  const auto allocate = [&mesh](const ContourSize& size)
  {
    mesh.points.resize(size.points);
    mesh.ownPoints = size.ownPoints;
    mesh.triangles.resize(size.triangles);
    mesh.view.resize(size.triangles);
    mesh.kind.resize(size.triangles);
    ContourArrays arrays;
    arrays.doublePoints = size.points ? mesh.points[0].data() : nullptr;
    arrays.triangles = size.triangles ? mesh.triangles[0].data() : nullptr;
    arrays.view = mesh.view.data();
    arrays.kind = mesh.kind.data();
    return arrays;
  };
  BisectionContour(field, bounds, options, allocate, progress, parallelFor);
  return mesh;
}

}
