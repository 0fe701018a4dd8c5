// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/TriangleIntersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<std::int32_t, 3>;

class IntersectionFinder
{
public:
  IntersectionFinder(const TriangleSoup& mesh, double gridCell)
    : Mesh(mesh)
    , GridCell(gridCell)
  {
  }

  std::vector<std::pair<std::size_t, std::size_t>> Run(const std::vector<std::size_t>& suspects,
    const std::function<bool(std::size_t a, std::size_t b)>& mayMeet,
    const ParallelFor& parallelFor)
  {
    std::vector<char> isSuspect(this->Mesh.count, 0);
    for (std::size_t suspect : suspects)
    {
      isSuspect[suspect] = 1;
      this->ForEachCell(suspect, [&](std::uint64_t cell) { this->Grid[cell]; });
    }
    for (std::size_t t = 0; t < this->Mesh.count && !suspects.empty(); ++t)
    {
      this->ForEachCell(t,
        [&](std::uint64_t cell)
        {
          const auto place = this->Grid.find(cell);
          if (place != this->Grid.end())
          {
            place->second.push_back(t);
          }
        });
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t suspect : suspects)
    {
      this->ForEachCell(suspect,
        [&](std::uint64_t cell)
        {
          for (std::size_t other : this->Grid[cell])
          {
            if ((other > suspect || !isSuspect[other]) && mayMeet(suspect, other))
            {
              pairs.emplace_back(std::min(suspect, other), std::max(suspect, other));
            }
          }
        });
      pairs.emplace_back(suspect, suspect);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<char> meet(pairs.size());
    parallelFor(pairs.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          meet[i] = this->Meet(pairs[i].first, pairs[i].second);
        }
      });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      pairs[kept] = pairs[i];
      kept += meet[i] != 0;
    }
    pairs.resize(kept);
    return pairs;
  }

private:
  Corners CornersOf(std::size_t t) const
  {
    const std::int32_t* ids = this->Mesh.triangles + 3 * t;
    return { ids[0], ids[1], ids[2] };
  }

  Kernel::Point_3 Place(std::int32_t vertex) const
  {
    const Vector3d p = this->Mesh.position(vertex);
    return Kernel::Point_3(p.x(), p.y(), p.z());
  }

  template <typename Visit>
  void ForEachCell(std::size_t t, Visit&& visit) const
  {
    Eigen::AlignedBox3d box;
    for (std::int32_t corner : this->CornersOf(t))
    {
      box.extend(this->Mesh.position(corner));
    }
    std::int64_t low[3], high[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::llround(std::floor(box.min()[axis] / this->GridCell));
      high[axis] = std::llround(std::floor(box.max()[axis] / this->GridCell));
    }
    const auto bits = [](std::int64_t x) { return static_cast<std::uint64_t>(x) & 0x1fffff; };
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
    {
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
      {
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
        {
          visit(bits(i) | bits(j) << 21 | bits(k) << 42);
        }
      }
    }
  }

  bool Meet(std::size_t first, std::size_t second) const
  {
    Corners a = this->CornersOf(first), b = this->CornersOf(second);
    if (first == second)
    {
      return CGAL::collinear(this->Place(a[0]), this->Place(a[1]), this->Place(a[2]));
    }
    // Brings what they share to the front, in the same order.
    int shared = 0;
    for (int i = 0; i < 3; ++i)
    {
      const auto same = std::find(b.begin() + shared, b.end(), a[i]);
      if (same != b.end())
      {
        std::iter_swap(b.begin() + shared, same);
        std::swap(a[shared++], a[i]);
      }
    }
    const Kernel::Point_3 p[3] = { this->Place(a[0]), this->Place(a[1]), this->Place(a[2]) };
    const Kernel::Point_3 q[3] = { this->Place(b[0]), this->Place(b[1]), this->Place(b[2]) };
    if (CGAL::collinear(p[0], p[1], p[2]) || CGAL::collinear(q[0], q[1], q[2]))
    {
      return false; // reported separately
    }
    const Kernel::Triangle_3 triangleA(p[0], p[1], p[2]), triangleB(q[0], q[1], q[2]);
    switch (shared)
    {
      case 0:
        return CGAL::do_intersect(triangleA, triangleB);
      case 1: // They meet elsewhere too if the side opposite of the corner meets the other triangle.
        return CGAL::do_intersect(triangleA, Kernel::Segment_3(q[1], q[2])) ||
          CGAL::do_intersect(triangleB, Kernel::Segment_3(p[1], p[2]));
      case 2: // Only when one is folded onto the other.
        return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
          CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
      default:
        return true;
    }
  }

  const TriangleSoup& Mesh;
  const double GridCell;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> Grid;
};

}

std::vector<std::pair<std::size_t, std::size_t>> FindIntersections(const TriangleSoup& mesh,
  const std::vector<std::size_t>& suspects, double gridCell,
  const std::function<bool(std::size_t a, std::size_t b)>& mayMeet, const ParallelFor& parallelFor)
{
  return IntersectionFinder(mesh, gridCell).Run(suspects, mayMeet, parallelFor);
}

}
