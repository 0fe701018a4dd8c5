// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/TriangleTree.h"

#include "Common/MortonOrder.h"
#include "Common/ParallelForWithProgress.h"
#include "Mesh/NearestOnTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

constexpr std::size_t LeafTriangles = 2;
constexpr std::size_t ChunkSize = 1024; // points that follow each other on one thread
constexpr int CurveBits = 63;
constexpr float Unbounded = std::numeric_limits<float>::infinity();
// What the squared distance to a box may be off for single precision, as a share of it.
constexpr float Rounding = 1e-6F;

/// The place along the Z-order curve of a point with coordinates in [0, 1].
std::uint64_t CurveKey(const Eigen::Array3d& point)
{
  constexpr double most = 0x1fffff;
  const auto at = [&](int axis)
  { return static_cast<std::uint32_t>(std::clamp(point[axis], 0.0, 1.0) * most); };
  return MortonKey(at(0), at(1), at(2));
}

/// Where to part items in the order of their keys: near the middle, and where the curve leaves the largest box.
std::size_t PlaceToPart(const std::vector<KeyedIndex>& items, std::size_t begin, std::size_t end)
{
  const std::size_t count = end - begin, middle = begin + count / 2;
  std::size_t best = middle;
  std::uint64_t leap = 0;
  for (std::size_t i = middle - count / 8; i <= middle + count / 8 && i > begin && i < end; ++i)
  {
    const std::uint64_t difference = items[i].key ^ items[i - 1].key;
    best = difference > leap ? i : best;
    leap = std::max(leap, difference);
  }
  return best;
}

/// Numbers 0 to 3 in descending order of four values, which are not negative: in the lowest bits of the values
/// themselves, whose bits as an integer have their order. Sorted without a branch.
std::array<std::uint32_t, 4> DescendingKeys(const Eigen::Array4f& values)
{
  std::array<std::uint32_t, 4> keys;
  std::memcpy(keys.data(), values.data(), sizeof keys);
  for (std::uint32_t i = 0; i < 4; ++i)
  {
    keys[i] = (keys[i] & ~3U) | i;
  }
  const auto order = [&keys](int i, int j)
  {
    const std::uint32_t greater = std::max(keys[i], keys[j]);
    keys[j] = std::min(keys[i], keys[j]);
    keys[i] = greater;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return keys;
}

/// The value, rounded down.
float DistanceOfKey(std::uint32_t key)
{
  const std::uint32_t bits = key & ~3U;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool IsFinite(const TriangleMesh& mesh, const std::array<int, 3>& corners)
{
  return mesh.points[corners[0]].allFinite() && mesh.points[corners[1]].allFinite() &&
    mesh.points[corners[2]].allFinite();
}

}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const ParallelFor& parallelFor)
{
  this->Sort(mesh, parallelFor);
  this->MakeBoxes(parallelFor);
}

std::size_t TriangleTree::FirstOf(int level, std::size_t node) const
{
  return this->Firsts[node << (2 * (this->Depth - level))];
}

void TriangleTree::Sort(const TriangleMesh& mesh, const ParallelFor& parallelFor)
{
  Eigen::AlignedBox3d bounds;
  std::vector<KeyedIndex> items;
  items.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (IsFinite(mesh, mesh.triangles[t]))
    {
      const auto& [a, b, c] = mesh.triangles[t];
      bounds.extend(mesh.points[a]).extend(mesh.points[b]).extend(mesh.points[c]);
      items.push_back({ 0, static_cast<int>(t) });
    }
  }
  if (items.empty())
  {
    return;
  }
  this->Origin = bounds.center();
  this->Margin = static_cast<float>(bounds.diagonal().norm()) * Rounding;
  const auto forItems = [&](const auto& body)
  {
    parallelFor(items.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto& [a, b, c] = mesh.triangles[items[i].index];
          body(i, mesh.points[a], mesh.points[b], mesh.points[c]);
        }
      });
  };
  const double side = bounds.sizes().maxCoeff();
  const double scale = side > 0 ? 1 / side : 0;
  forItems([&](std::size_t i, const Vector3d& a, const Vector3d& b, const Vector3d& c)
    { items[i].key = CurveKey(((a + b + c) / 3 - bounds.min()).array() * scale); });
  SortByKey(items, CurveBits);
  this->Indices.resize(items.size());
  this->Triangles.resize(items.size());
  while ((items.size() >> (2 * this->Depth)) >= LeafTriangles)
  {
    ++this->Depth;
  }
  this->Firsts.resize((std::size_t(1) << (2 * this->Depth)) + 1);
  this->Firsts.back() = static_cast<std::uint32_t>(items.size());
  for (std::size_t step = this->Firsts.size() - 1; step > 1; step /= 2)
  {
    parallelFor(this->Firsts.size() / step,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t first = begin * step; first < end * step; first += step)
        {
          this->Firsts[first + step / 2] = static_cast<std::uint32_t>(
            PlaceToPart(items, this->Firsts[first], this->Firsts[first + step]));
        }
      });
  }
  forItems(
    [&](std::size_t i, const Vector3d& a, const Vector3d& b, const Vector3d& c)
    {
      this->Indices[i] = items[i].index;
      this->Triangles[i] = { a, b, c };
    });
}

void TriangleTree::SetBox(std::size_t node, int level, std::size_t numberInLevel, int child)
{
  Eigen::Array3f low = Eigen::Array3f::Constant(Unbounded), high = -low;
  if (level + 1 < this->Depth)
  {
    const Node& inner = this->Nodes[4 * node + 1 + child];
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = inner.low[axis].minCoeff();
      high[axis] = inner.high[axis].maxCoeff();
    }
  }
  else
  {
    const std::size_t leaf = 4 * numberInLevel + child;
    for (std::size_t i = this->FirstOf(level + 1, leaf); i < this->FirstOf(level + 1, leaf + 1);
         ++i)
    {
      for (const Vector3d* corner :
        { &this->Triangles[i].a, &this->Triangles[i].b, &this->Triangles[i].c })
      {
        const Eigen::Array3f place = (*corner - this->Origin).cast<float>().array();
        low = low.min(place - this->Margin);
        high = high.max(place + this->Margin);
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Nodes[node].low[axis][child] = low[axis];
    this->Nodes[node].high[axis][child] = high[axis];
  }
}

void TriangleTree::MakeBoxes(const ParallelFor& parallelFor)
{
  if (this->IsEmpty())
  {
    return;
  }
  this->Nodes.resize(((std::size_t(1) << (2 * this->Depth)) - 1) / 3);
  for (int level = this->Depth - 1; level >= 0; --level)
  {
    const std::size_t count = std::size_t(1) << (2 * level), first = (count - 1) / 3;
    parallelFor(count,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          for (int child = 0; child < 4; ++child)
          {
            this->SetBox(first + i, level, i, child);
          }
        }
      });
  }
}

void TriangleTree::Look(std::size_t place, const Vector3d& point, Best& best) const
{
  const auto& [a, b, c] = this->Triangles[place];
  const Vector3d weights = NearestOnTriangle(point, a, b, c);
  // By differences to the point, as the coordinates may be much larger than the distance.
  const double squared =
    (weights[0] * (a - point) + weights[1] * (b - point) + weights[2] * (c - point)).squaredNorm();
  if (squared < best.squared || (squared == best.squared && best.place < 0))
  {
    best = { squared, static_cast<std::int64_t>(place) };
  }
}

void TriangleTree::Search(const Vector3d& point, Best& best) const
{
  struct Waiting
  {
    float squared;
    int level;
    std::size_t node;
  };
  const Eigen::Array3f p = (point - this->Origin).cast<float>().array();
  std::array<Waiting, 128> stack;
  int height = 0;
  stack[height++] = { 0, 0, 0 };
  const std::size_t firstLeaf = ((std::size_t(1) << (2 * this->Depth)) - 1) / 3;
  while (height > 0)
  {
    const Waiting next = stack[--height];
    if (next.squared > best.squared)
    {
      continue;
    }
    if (next.level == this->Depth)
    {
      const std::size_t leaf = next.node - firstLeaf, end = this->FirstOf(next.level, leaf + 1);
      for (std::size_t i = this->FirstOf(next.level, leaf); i < end; ++i)
      {
        this->Look(i, point, best);
      }
      continue;
    }
    const Node& node = this->Nodes[next.node];
    Eigen::Array4f squared = Eigen::Array4f::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      squared += (node.low[axis] - p[axis]).max(p[axis] - node.high[axis]).max(0.0F).square();
    }
    // The nearest child comes to the top.
    for (const std::uint32_t key : DescendingKeys(squared * (1 - Rounding)))
    {
      const float ofChild = DistanceOfKey(key);
      if (ofChild <= best.squared)
      {
        stack[height++] = { ofChild, next.level + 1, 4 * next.node + 1 + (key & 3) };
      }
    }
  }
}

std::vector<NearestPlace> TriangleTree::Find(const std::vector<Vector3d>& points, double reach,
  const ParallelFor& parallelFor, const Progress& progress) const
{
  std::vector<NearestPlace> found(points.size());
  const std::size_t chunks = this->IsEmpty() ? 0 : (points.size() + ChunkSize - 1) / ChunkSize;
  ParallelForWithProgress(chunks, parallelFor, progress,
    [&](std::size_t chunk, const CancellationFlag& stop)
    {
      ThrowIfCancelled(stop);
      std::int64_t last = -1;
      for (std::size_t i = chunk * ChunkSize; i < std::min((chunk + 1) * ChunkSize, points.size());
           ++i)
      {
        if (!points[i].allFinite())
        {
          continue;
        }
        Best best{ reach * reach };
        if (last >= 0)
        {
          this->Look(static_cast<std::size_t>(last), points[i], best);
        }
        this->Search(points[i], best);
        if (best.place >= 0)
        {
          last = best.place;
          found[i] = { std::sqrt(best.squared), this->Indices[best.place] };
        }
      }
    });
  return found;
}

}
