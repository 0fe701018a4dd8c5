// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/RasterMesh.h"

#include "Common/GroupedLists.h"

#include <cmath>
#include <cstdint>

namespace freespace
{

using Eigen::Vector2d;

namespace
{

constexpr int LongestWalk = 48; // triangles
constexpr std::int64_t MostRasterCells = 1 << 23;
constexpr double CellsPerTriangle = 3.0;

}

RasterMesh::RasterMesh(const DisparityMap& map, const CancellationFlag& stop)
{
  this->FromWorld << map.camera.K * map.camera.R, map.camera.K * map.camera.t;
  this->AddTriangles(map);
  if (!this->AllTriangles.empty())
  {
    this->ScaleToRaster();
    this->DropFlatTriangles();
  }
  if (this->AllTriangles.empty())
  {
    this->Columns = this->Rows = 0;
    return;
  }
  ThrowIfCancelled(stop);
  this->SortByTile();
  this->LinkNeighbors(stop);
}

void RasterMesh::AddTriangles(const DisparityMap& map)
{
  const std::size_t n = map.points.size();
  std::vector<char> usable(n, 0);
  this->AllCorners.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double depth = map.camera.Depth(map.points[i]);
    usable[i] = map.imagePoints[i].allFinite() && std::isfinite(depth) && depth > 0;
    this->AllCorners[i] = { map.imagePoints[i], 1.0 / depth };
  }
  this->AllTriangles.reserve(map.triangles.size());
  for (std::size_t t = 0; t < map.triangles.size(); ++t)
  {
    std::array<int, 3> c = map.triangles[t];
    if (!usable[c[0]] || !usable[c[1]] || !usable[c[2]])
    {
      continue;
    }
    Triangle triangle;
    triangle.corner = c;
    triangle.neighbor = { -1, -1, -1 };
    triangle.id = static_cast<int>(t);
    this->AllTriangles.push_back(triangle);
  }
}

// Gives the raster square cells, a few for each triangle.
void RasterMesh::ScaleToRaster()
{
  Eigen::AlignedBox2d box;
  for (const Triangle& triangle : this->AllTriangles)
  {
    for (int i : triangle.corner)
    {
      box.extend(this->AllCorners[i].position);
    }
  }
  const Vector2d size = box.sizes().cwiseMax(1e-9 * (1.0 + box.sizes().maxCoeff()));
  const double wanted = std::min<double>(
    static_cast<double>(MostRasterCells), CellsPerTriangle * this->AllTriangles.size() + 16.0);
  const double side = std::max(std::sqrt(size.prod() / wanted), size.maxCoeff() / (0.5 * wanted));
  this->Columns = static_cast<int>(size.x() / side) + 1;
  this->Rows = static_cast<int>(size.y() / side) + 1;
  const Eigen::RowVector4d depthRow = this->FromWorld.row(2);
  for (int axis = 0; axis < 2; ++axis)
  {
    this->FromWorld.row(axis) = (this->FromWorld.row(axis) - box.min()[axis] * depthRow) / side;
  }
  for (Corner& corner : this->AllCorners)
  {
    corner.position = (corner.position - box.min()) / side;
  }
}

// Computes the slopes and orients all triangles; drops those without area.
void RasterMesh::DropFlatTriangles()
{
  const auto flat = [this](Triangle& t)
  {
    const Corner &a = this->AllCorners[t.corner[0]], &b = this->AllCorners[t.corner[1]],
                 &c = this->AllCorners[t.corner[2]];
    const Vector2d ab = b.position - a.position, ac = c.position - a.position;
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    const double ub = b.disparity - a.disparity, uc = c.disparity - a.disparity;
    t.slopeX = (ub * ac.y() - uc * ab.y()) / area;
    t.slopeY = (uc * ab.x() - ub * ac.x()) / area;
    if (area < 0)
    {
      std::swap(t.corner[1], t.corner[2]);
    }
    return area == 0 || !std::isfinite(t.slopeX) || !std::isfinite(t.slopeY);
  };
  this->AllTriangles.erase(
    std::remove_if(this->AllTriangles.begin(), this->AllTriangles.end(), flat),
    this->AllTriangles.end());
}

// Sorts triangles and corners tile by tile of the raster, so that those that are close in the image
// are close in memory, for the cache.
void RasterMesh::SortByTile()
{
  constexpr double tile = 8; // cells
  const int columns = static_cast<int>(this->Columns / tile) + 1;
  const int rows = static_cast<int>(this->Rows / tile) + 1;
  const GroupedLists<int> tiles(static_cast<std::size_t>(columns) * rows,
    [&](const auto& add)
    {
      for (std::size_t t = 0; t < this->AllTriangles.size(); ++t)
      {
        const Vector2d& position = this->AllCorners[this->AllTriangles[t].corner[0]].position;
        const int column = static_cast<int>(position.x() / tile);
        add(static_cast<int>(position.y() / tile) * columns + column, static_cast<int>(t));
      }
    });
  std::vector<Triangle> sorted;
  sorted.reserve(this->AllTriangles.size());
  for (const int t : tiles.AllValues())
  {
    sorted.push_back(this->AllTriangles[t]);
  }
  this->AllTriangles = std::move(sorted);
  std::vector<int> newIndex(this->AllCorners.size(), -1);
  std::vector<Corner> corners;
  corners.reserve(this->AllCorners.size());
  for (Triangle& triangle : this->AllTriangles)
  {
    for (int& corner : triangle.corner)
    {
      if (newIndex[corner] < 0)
      {
        newIndex[corner] = static_cast<int>(corners.size());
        corners.push_back(this->AllCorners[corner]);
      }
      corner = newIndex[corner];
    }
  }
  this->AllCorners = std::move(corners);
}

void RasterMesh::LinkNeighbors(const CancellationFlag& stop)
{
  const auto ends = [this](int side)
  {
    const auto& corner = this->AllTriangles[side / 3].corner;
    return std::minmax(corner[side % 3], corner[(side + 1) % 3]);
  };
  // The edges of each corner, listed at their smaller corner.
  const int sides = 3 * static_cast<int>(this->AllTriangles.size());
  const GroupedLists<int> edges(this->AllCorners.size(),
    [&](const auto& add)
    {
      for (int side = 0; side < sides; ++side)
      {
        add(ends(side).first, side);
      }
    });
  for (std::size_t c = 0; c < this->AllCorners.size(); ++c)
  {
    ThrowIfCancelled(stop);
    const GroupedLists<int>::Range bucket = edges[c];
    for (std::size_t i = 0; i < bucket.size(); ++i)
    {
      int& neighbor = this->AllTriangles[bucket[i] / 3].neighbor[bucket[i] % 3];
      for (std::size_t j = i + 1; j < bucket.size() && neighbor < 0; ++j)
      {
        int& other = this->AllTriangles[bucket[j] / 3].neighbor[bucket[j] % 3];
        if (other < 0 && ends(bucket[i]).second == ends(bucket[j]).second)
        {
          neighbor = bucket[j] / 3;
          other = bucket[i] / 3;
        }
      }
    }
  }
}

double RasterMesh::Disparity(const Triangle& triangle, double x, double y) const
{
  const Corner& a = this->AllCorners[triangle.corner[0]];
  const double u = this->AllCorners[triangle.corner[1]].disparity;
  const double v = this->AllCorners[triangle.corner[2]].disparity;
  const double disparity =
    a.disparity + triangle.slopeX * (x - a.position.x()) + triangle.slopeY * (y - a.position.y());
  return std::clamp(disparity, std::min({ a.disparity, u, v }), std::max({ a.disparity, u, v }));
}

RasterMesh::Walk RasterMesh::WalkTo(double x, double y, int start) const
{
  int at = start, from = -1;
  for (int step = 0; step < LongestWalk; ++step)
  {
    const Triangle& triangle = this->AllTriangles[at];
    int crossed = -1;
    for (int i = 0; i < 3 && crossed < 0; ++i)
    {
      const int neighbor = triangle.neighbor[i];
      if ((neighbor != from || neighbor < 0) &&
        this->Turn(triangle.corner[i], triangle.corner[(i + 1) % 3], x, y) < 0)
      {
        crossed = i;
      }
    }
    if (crossed < 0 || triangle.neighbor[crossed] < 0)
    {
      return { true, at, crossed };
    }
    from = at;
    at = triangle.neighbor[crossed];
  }
  return { false, at, -1 };
}

}
