// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/TriangleIntersections.h"

#include "Mesh/BoxGrid.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<std::int32_t, 3>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
using MayMeet = std::function<bool(std::size_t a, std::size_t b)>;

class IntersectionFinder
{
public:
  IntersectionFinder(const TriangleSoup& mesh, double gridCell)
    : Mesh(mesh)
    , GridCell(gridCell)
  {
  }

  Pairs Run(const std::vector<std::size_t>& suspects, const MayMeet& mayMeet,
    const ParallelFor& parallelFor)
  {
    Pairs pairs = this->FindCandidates(suspects, mayMeet, parallelFor);
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

  void FindBoxes(const ParallelFor& parallelFor)
  {
    this->Boxes.resize(this->Mesh.count);
    parallelFor(this->Mesh.count,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin; t < end; ++t)
        {
          this->Boxes[t].setEmpty();
          for (const std::int32_t corner : this->CornersOf(t))
          {
            this->Boxes[t].extend(this->Mesh.position(corner));
          }
        }
      });
  }

  // Pairs whose boxes intersect, in ascending order; each suspect with itself.
  Pairs FindCandidates(const std::vector<std::size_t>& suspects, const MayMeet& mayMeet,
    const ParallelFor& parallelFor)
  {
    if (suspects.empty())
    {
      return {};
    }
    this->FindBoxes(parallelFor);
    std::vector<char> isSuspect(this->Mesh.count, 0);
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max());
    for (const std::size_t suspect : suspects)
    {
      isSuspect[suspect] = 1;
      low = low.cwiseMin(this->Boxes[suspect].min());
    }
    const BoxGrid grid(suspects.size(), low, this->GridCell,
      [&](std::size_t i) { return this->Boxes[suspects[i]]; });
    constexpr std::size_t together = 4096;
    std::vector<Pairs> found((this->Mesh.count + together - 1) / together);
    parallelFor(found.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin * together; t < std::min(end * together, this->Mesh.count); ++t)
        {
          this->AddPairs(t, suspects, isSuspect[t] != 0, grid, mayMeet, found[t / together]);
        }
      });
    Pairs pairs;
    for (const Pairs& some : found)
    {
      pairs.insert(pairs.end(), some.begin(), some.end());
    }
    for (const std::size_t suspect : suspects)
    {
      pairs.emplace_back(suspect, suspect);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  // The suspects that a triangle may meet; of two suspects the later one finds the earlier one.
  void AddPairs(std::size_t t, const std::vector<std::size_t>& suspects, bool isSuspect,
    const BoxGrid& grid, const MayMeet& mayMeet, Pairs& pairs) const
  {
    const Eigen::AlignedBox3d& box = this->Boxes[t];
    grid.ForEachNear(box,
      [&](std::int32_t item, const BoxGrid::Cell& cell)
      {
        const std::size_t suspect = suspects[item];
        if (suspect == t || (isSuspect && suspect > t))
        {
          return;
        }
        const Eigen::AlignedBox3d& other = this->Boxes[suspect];
        // In one of the cells that they share.
        if (box.intersects(other) && grid.CellOf(box.min().cwiseMax(other.min())) == cell &&
          mayMeet(suspect, t))
        {
          pairs.emplace_back(std::minmax(suspect, t));
        }
      });
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
  std::vector<Eigen::AlignedBox3d> Boxes;
};

}

std::vector<std::pair<std::size_t, std::size_t>> FindIntersections(const TriangleSoup& mesh,
  const std::vector<std::size_t>& suspects, double gridCell,
  const std::function<bool(std::size_t a, std::size_t b)>& mayMeet, const ParallelFor& parallelFor)
{
  return IntersectionFinder(mesh, gridCell).Run(suspects, mayMeet, parallelFor);
}

}
