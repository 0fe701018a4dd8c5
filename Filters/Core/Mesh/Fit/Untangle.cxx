// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/Untangle.h"

#include "Mesh/TriangleIntersections.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

// A vertex is moved back by halves, finally to its previous position.
constexpr double LeastShare = 0.2;

class Untangler
{
public:
  Untangler(std::vector<Vector3d>& points, const std::vector<Vector3d>& original,
    const Triangles& triangles, const UntangleOptions& options)
    : Points(points)
    , Original(original)
    , Moved(points)
    , Corners(triangles)
    , Options(options)
    , Share(points.size(), 1.0)
  {
    for (std::size_t v = 0; v < points.size(); ++v)
    {
      this->Place(v);
    }
  }

  void Run(const Progress& progress, const ParallelFor& parallelFor);

private:
  void Place(std::size_t v);
  bool IsApart(std::size_t a, std::size_t b) const;
  bool IsBeside(const Vector3d* a, const Vector3d* b) const;
  std::vector<std::size_t> TrianglesAt(const std::vector<char>& isVertex) const;

  std::vector<Vector3d>& Points;
  const std::vector<Vector3d>& Original;
  const std::vector<Vector3d> Moved;
  const Triangles& Corners;
  const UntangleOptions& Options;
  std::vector<double> Share; // of its move that each vertex keeps
};

void Untangler::Place(std::size_t v)
{
  Vector3d& point = this->Points[v];
  point = this->Share[v] == 0
    ? this->Original[v]
    : Vector3d(this->Original[v] + this->Share[v] * (this->Moved[v] - this->Original[v]));
  if (this->Options.isSingle)
  {
    point = point.cast<float>().cast<double>();
  }
}

// Whether all corners of b are beyond the plane of a, or beyond one of its sides: then they do not intersect.
bool Untangler::IsBeside(const Vector3d* a, const Vector3d* b) const
{
  const Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const double room = 1e-9 * this->Options.cell;
  const auto parts = [&](const Vector3d& direction, const Vector3d& origin, double sign)
  {
    const double least = room * direction.norm();
    return std::all_of(
      b, b + 3, [&](const Vector3d& p) { return sign * direction.dot(p - origin) > least; });
  };
  if (parts(normal, a[0], 1) || parts(normal, a[0], -1))
  {
    return true;
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vector3d outwards = (a[(i + 1) % 3] - a[i]).cross(normal);
    if (parts(outwards, a[i], 1))
    {
      return true;
    }
  }
  return false;
}

// Triangles that share a corner are left to the exact test, unless they turn away from each other.
bool Untangler::IsApart(std::size_t first, std::size_t second) const
{
  Vector3d a[3], b[3];
  int shared = 0, sharedOfA = 0, sharedOfB = 0;
  for (int i = 0; i < 3; ++i)
  {
    a[i] = this->Points[this->Corners[first][i]];
    b[i] = this->Points[this->Corners[second][i]];
    for (int j = 0; j < 3; ++j)
    {
      if (this->Corners[first][i] == this->Corners[second][j])
      {
        ++shared;
        sharedOfA = i;
        sharedOfB = j;
      }
    }
  }
  if (shared == 0)
  {
    return this->IsBeside(a, b) || this->IsBeside(b, a);
  }
  const Vector3d n = (a[1] - a[0]).cross(a[2] - a[0]), m = (b[1] - b[0]).cross(b[2] - b[0]);
  if (shared > 1)
  {
    // They would have to be folded flat onto each other.
    return n.dot(m) > -0.99 * n.norm() * m.norm();
  }
  // A plane through the corner that the other corners lie to different sides of.
  const Vector3d &corner = a[sharedOfA], &p = a[(sharedOfA + 1) % 3], &q = a[(sharedOfA + 2) % 3],
                 &r = b[(sharedOfB + 1) % 3], &s = b[(sharedOfB + 2) % 3];
  const Vector3d towards = (p - corner).normalized() + (q - corner).normalized() -
    (r - corner).normalized() - (s - corner).normalized();
  const double room = 1e-9 * this->Options.cell * towards.norm();
  return towards.dot(p - corner) > room && towards.dot(q - corner) > room &&
    towards.dot(r - corner) < -room && towards.dot(s - corner) < -room;
}

std::vector<std::size_t> Untangler::TrianglesAt(const std::vector<char>& isVertex) const
{
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < this->Corners.size(); ++t)
  {
    const auto& [a, b, c] = this->Corners[t];
    if (isVertex[a] || isVertex[b] || isVertex[c])
    {
      found.push_back(t);
    }
  }
  return found;
}

void Untangler::Run(const Progress& progress, const ParallelFor& parallelFor)
{
  TriangleSoup soup;
  soup.position = [this](std::int32_t vertex) { return this->Points[vertex]; };
  soup.triangles = this->Corners.empty() ? nullptr : this->Corners.front().data();
  soup.count = this->Corners.size();
  std::vector<char> changed(this->Points.size());
  for (std::size_t v = 0; v < changed.size(); ++v)
  {
    changed[v] = this->Points[v] != this->Original[v];
  }
  std::vector<std::size_t> suspects = this->TrianglesAt(changed);
  double done = 0;
  while (!suspects.empty())
  {
    progress(done);
    done = 0.5 * (1 + done);
    const auto pairs = FindIntersections(
      soup, suspects, this->Options.cell,
      [this](std::size_t a, std::size_t b) { return !this->IsApart(a, b); }, parallelFor);
    std::fill(changed.begin(), changed.end(), 0);
    for (const auto& [a, b] : pairs)
    {
      for (const std::size_t t : { a, b })
      {
        for (const int corner : this->Corners[t])
        {
          changed[corner] = this->Share[corner] > 0;
        }
      }
    }
    for (std::size_t v = 0; v < changed.size(); ++v)
    {
      if (changed[v])
      {
        this->Share[v] = this->Share[v] > LeastShare ? 0.5 * this->Share[v] : 0.0;
        this->Place(v);
      }
    }
    suspects = this->TrianglesAt(changed);
  }
  progress(1.0);
}

}

void Untangle(std::vector<Vector3d>& points, const std::vector<Vector3d>& original,
  const Triangles& triangles, const UntangleOptions& options, const Progress& progress,
  const ParallelFor& parallelFor)
{
  Untangler(points, original, triangles, options).Run(progress, parallelFor);
}

}
