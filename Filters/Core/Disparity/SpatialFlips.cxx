// SPDX-License-Identifier: BSD-3-Clause
// The part of DisparitySurface that flips edges: a data-dependent triangulation (N. Dyn, D. Levin, S. Rippa,
// "Data dependent triangulations for piecewise linear interpolation", IMA Journal of Numerical Analysis, 1990), whose
// criterion is Delaunay's on the surface itself.
#include "Disparity/DisparitySurface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace freespace
{

namespace
{

// Flips and the constraint follow each other at most so often.
constexpr int MaximumRounds = 4;
constexpr int MaximumPasses = 8;

// By how much of itself a flip may raise the disparity between the four points. Each diagonal would be a surface free
// of edges, so that the space before either is free: a flip that raises more gives free space away.
constexpr double MostRise = 1e-3;

// The cotangent of the angle at `apex` in the triangle with a and b.
double Cotangent(const Eigen::Vector3d& apex, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double sine = (a - apex).cross(b - apex).norm();
  const double cosine = (a - apex).dot(b - apex);
  return sine > 0 ? cosine / sine : std::copysign(std::numeric_limits<double>::infinity(), cosine);
}

// An edge as an unordered pair of points.
std::uint64_t EdgeKey(int a, int b)
{
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
}

}

// Whether the edge between two triangles was looked at, from either side, since they last changed: it is as good now as
// it was then.
template <typename Triangulation>
bool DisparitySurface<Triangulation>::IsSettled(Face face, Face neighbor)
{
  const unsigned int changed = std::max(face->info().changed, neighbor->info().changed);
  return face->info().lookedAt > changed || neighbor->info().lookedAt > changed;
}

// How much greater the disparity is where the diagonals of a strictly convex quadrangle cross in the image, as a share,
// when that from a to b is replaced by that from apex to other.
template <typename Triangulation>
double DisparitySurface<Triangulation>::RiseOfFlip(Vertex apex, Vertex a, Vertex other, Vertex b)
{
  const auto across = other->point() - apex->point();
  const auto along = b->point() - a->point();
  const auto offset = a->point() - apex->point();
  const auto cross = [](const auto& u, const auto& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double area = cross(across, along);
  const auto disparity = [](Vertex from, Vertex to, double share)
  { return from->info().disparity + share * (to->info().disparity - from->info().disparity); };
  const double before = disparity(a, b, cross(offset, across) / area);
  const double after = disparity(apex, other, cross(offset, along) / area);
  return after / before - 1;
}

// Whether the edge opposite a vertex of a triangle is to be flipped: the quadrangle is strictly convex in the image,
// and the other diagonal is the better one in space and gives no free space away.
template <typename Triangulation>
bool DisparitySurface<Triangulation>::WantsFlip(Face face, int index, double leastCotangents) const
{
  const Face neighbor = face->neighbor(index);
  if (this->Delaunay.is_infinite(neighbor))
  {
    return false;
  }
  const Vertex apex = face->vertex(index);
  const Vertex a = face->vertex(Triangulation::ccw(index));
  const Vertex b = face->vertex(Triangulation::cw(index));
  const Vertex other = neighbor->vertex(neighbor->index(face));
  const auto point = [this](Vertex vertex) -> const Eigen::Vector3d&
  { return this->Points[static_cast<std::size_t>(vertex->info().point)].point; };
  const double sum =
    Cotangent(point(apex), point(a), point(b)) + Cotangent(point(other), point(a), point(b));
  if (!(sum < leastCotangents) || this->Kept.count(EdgeKey(a->info().point, b->info().point)) > 0)
  {
    return false;
  }
  const double flipped =
    Cotangent(point(a), point(apex), point(other)) + Cotangent(point(b), point(apex), point(other));
  return flipped > sum &&
    CGAL::orientation(apex->point(), a->point(), other->point()) == CGAL::LEFT_TURN &&
    CGAL::orientation(other->point(), b->point(), apex->point()) == CGAL::LEFT_TURN &&
    RiseOfFlip(apex, a, other, b) <= MostRise;
}

// Flips the edge opposite a vertex of a triangle and distributes the candidates of the two triangles anew.
template <typename Triangulation>
void DisparitySurface<Triangulation>::Flip(Face face, int index)
{
  const Vertex apex = face->vertex(index);
  this->Star = { face, face->neighbor(index) };
  this->TakeCandidates(-1);
  if constexpr (std::is_same_v<Triangulation, ConstrainedTriangulation>)
  {
    this->Delaunay.flip(face, index);
  }
  else
  {
    this->Delaunay.tds().flip(face, index);
  }
  this->Redistribute(apex);
}

// One pass over all edges. Returns how many it flipped.
template <typename Triangulation>
int DisparitySurface<Triangulation>::FlipOnce(double leastCotangents, const CancellationFlag& stop)
{
  int flips = 0;
  for (const Face face : this->Delaunay.finite_face_handles())
  {
    ThrowIfCancelled(stop);
    const unsigned int now = this->Changes + 1;
    for (int i = 0; i < 3; ++i)
    {
      if (!IsSettled(face, face->neighbor(i)) && this->WantsFlip(face, i, leastCotangents))
      {
        this->Flip(face, i);
        ++flips;
      }
    }
    face->info().lookedAt = now;
  }
  return flips;
}

template <typename Triangulation>
void DisparitySurface<Triangulation>::FlipEdges(
  double leastCotangents, const std::vector<std::array<int, 2>>& kept, const CancellationFlag& stop)
{
  for (const auto& [a, b] : kept)
  {
    this->Kept.insert(EdgeKey(this->OfFeature[a]->info().point, this->OfFeature[b]->info().point));
  }
  for (int round = 0; round < MaximumRounds; ++round)
  {
    int flips = 0;
    for (int pass = 0; pass < MaximumPasses; ++pass)
    {
      const int more = this->FlipOnce(leastCotangents, stop);
      flips += more;
      if (more == 0)
      {
        break;
      }
    }
    if (flips == 0)
    {
      break;
    }
    this->InsertHighest(stop);
  }
}

template bool DisparitySurface<PlainTriangulation>::IsSettled(Face, Face);
template double DisparitySurface<PlainTriangulation>::RiseOfFlip(Vertex, Vertex, Vertex, Vertex);
template bool DisparitySurface<PlainTriangulation>::WantsFlip(Face, int, double) const;
template void DisparitySurface<PlainTriangulation>::Flip(Face, int);
template int DisparitySurface<PlainTriangulation>::FlipOnce(double, const CancellationFlag&);
template void DisparitySurface<PlainTriangulation>::FlipEdges(
  double, const std::vector<std::array<int, 2>>&, const CancellationFlag&);
template bool DisparitySurface<ConstrainedTriangulation>::IsSettled(Face, Face);
template double DisparitySurface<ConstrainedTriangulation>::RiseOfFlip(
  Vertex, Vertex, Vertex, Vertex);
template bool DisparitySurface<ConstrainedTriangulation>::WantsFlip(Face, int, double) const;
template void DisparitySurface<ConstrainedTriangulation>::Flip(Face, int);
template int DisparitySurface<ConstrainedTriangulation>::FlipOnce(double, const CancellationFlag&);
template void DisparitySurface<ConstrainedTriangulation>::FlipEdges(
  double, const std::vector<std::array<int, 2>>&, const CancellationFlag&);

}
