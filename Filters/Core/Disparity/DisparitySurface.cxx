// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/DisparitySurface.h"

#include "Common/Error.h"
#include "Common/MortonOrder.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace freespace
{

namespace
{

// Indices along a space-filling curve (Morton order), so that consecutive points are close
// together.
template <typename Sightings>
std::vector<std::size_t> SpatialOrder(const Sightings& sightings)
{
  constexpr double steps = 65535;
  Eigen::AlignedBox2d box;
  for (const Sighting& sighting : sightings)
  {
    box.extend(Eigen::Vector2d(sighting.pixel.x(), sighting.pixel.y()));
  }
  const double scale = steps / std::max(box.sizes().maxCoeff(), 1e-9);
  std::vector<KeyedIndex> keys;
  keys.reserve(sightings.size());
  for (const Sighting& sighting : sightings)
  {
    const auto x = static_cast<std::uint16_t>((sighting.pixel.x() - box.min().x()) * scale);
    const auto y = static_cast<std::uint16_t>((sighting.pixel.y() - box.min().y()) * scale);
    keys.push_back({ MortonKey(x, y), static_cast<int>(keys.size()) });
  }
  SortByKey(keys, 32);
  std::vector<std::size_t> order(keys.size());
  std::transform(
    keys.begin(), keys.end(), order.begin(), [](const KeyedIndex& key) { return key.index; });
  return order;
}

double Cross(const Pixel& a, const Pixel& b, const Pixel& origin)
{
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

}

template <typename Triangulation>
void DisparitySurface<Triangulation>::TriangulateFeatures(
  const std::vector<SightedPoint>& features, const CancellationFlag& stop)
{
  if (features.size() < 3)
  {
    throw Error("View '" + this->Name + "' has " + std::to_string(features.size()) +
      " usable features, but a disparity map needs at least three.");
  }
  std::vector<Vertex> vertices(features.size());
  this->OfFeature.resize(features.size());
  Face hint;
  for (const std::size_t i : SpatialOrder(features))
  {
    ThrowIfCancelled(stop);
    const std::size_t before = this->Delaunay.number_of_vertices();
    const Vertex vertex = this->Delaunay.insert(features[i].pixel, hint);
    hint = vertex->face();
    this->OfFeature[i] = vertex;
    const bool isNew = this->Delaunay.number_of_vertices() > before;
    if (isNew || features[i].disparity > features[vertex->info().point].disparity)
    {
      vertex->info().point = static_cast<int>(i);
    }
  }
  if (this->Delaunay.dimension() < 2)
  {
    throw Error("View '" + this->Name + "' has only collinear features, which span no triangle.");
  }
  for (const Vertex vertex : this->Delaunay.finite_vertex_handles())
  {
    vertices[vertex->info().point] = vertex;
  }
  for (std::size_t i = 0; i < features.size(); ++i)
  {
    if (vertices[i] != Vertex())
    {
      vertices[i]->info() = { static_cast<int>(this->Points.size()), features[i].disparity };
      this->Points.push_back(features[i]);
    }
  }
}

// Edges that intersect earlier ones are skipped.
template <typename Triangulation>
void DisparitySurface<Triangulation>::KeepEdges(const std::vector<std::array<int, 2>>& edges)
{
  if constexpr (std::is_same_v<Triangulation, ConstrainedTriangulation>)
  {
    for (const auto& [a, b] : edges)
    {
      if (this->OfFeature[a] != this->OfFeature[b])
      {
        try
        {
          this->Delaunay.insert_constraint(this->OfFeature[a], this->OfFeature[b]);
        }
        catch (const typename Triangulation::Intersection_of_constraints_exception&)
        {
        }
      }
    }
  }
}

// The disparity of a triangle at a pixel inside it, by barycentric interpolation.
template <typename Triangulation>
double DisparitySurface<Triangulation>::Disparity(Face face, const Pixel& pixel) const
{
  double weighted = 0, sum = 0, greatest = 0;
  for (int i = 0; i < 3; ++i)
  {
    // The pixel is inside by an exact test: a negative weight is a rounding error.
    const double weight = std::max(0.0,
      Cross(face->vertex(Triangulation::ccw(i))->point(),
        face->vertex(Triangulation::cw(i))->point(), pixel));
    const double disparity = face->vertex(i)->info().disparity;
    weighted += weight * disparity;
    sum += weight;
    greatest = std::max(greatest, disparity);
  }
  return sum > 0 ? weighted / sum : greatest;
}

template <typename Triangulation>
void DisparitySurface<Triangulation>::PutInto(Face face, int candidate)
{
  Candidate& point = this->Candidates[candidate];
  point.height = point.disparity - this->Disparity(face, point.pixel);
  point.next = face->info().firstCandidate;
  face->info().firstCandidate = candidate;
}

// Pushes the triangle's highest candidate onto the queue, if it is above the tolerance.
template <typename Triangulation>
void DisparitySurface<Triangulation>::Enqueue(Face face)
{
  Highest highest{ 0, -1, -1, face, face->info().changed };
  for (int c = face->info().firstCandidate; c >= 0; c = this->Candidates[c].next)
  {
    const Candidate& point = this->Candidates[c];
    if (point.height > this->Tolerance * point.disparity)
    {
      const Highest entry{ point.height, c, point.given, face, face->info().changed };
      if (highest.candidate < 0 || highest < entry)
      {
        highest = entry;
      }
    }
  }
  if (highest.candidate >= 0)
  {
    this->Queue.push(highest);
  }
}

// Strictly inside: no other triangle contains the pixel.
template <typename Triangulation>
bool DisparitySurface<Triangulation>::IsInside(Face face, const Pixel& pixel) const
{
  const Pixel &a = face->vertex(0)->point(), &b = face->vertex(1)->point(),
              &c = face->vertex(2)->point();
  return !this->Delaunay.is_infinite(face) && CGAL::orientation(a, b, pixel) == CGAL::LEFT_TURN &&
    CGAL::orientation(b, c, pixel) == CGAL::LEFT_TURN &&
    CGAL::orientation(c, a, pixel) == CGAL::LEFT_TURN;
}

// Only points inside the convex hull can be above the surface.
template <typename Triangulation>
void DisparitySurface<Triangulation>::AddCandidates(
  std::vector<SightedFeature> sightings, const CancellationFlag& stop)
{
  this->Given = std::move(sightings);
  this->Candidates.reserve(this->Given.size());
  Face hint;
  for (const std::size_t i : SpatialOrder(this->Given))
  {
    ThrowIfCancelled(stop);
    const Sighting& sighting = this->Given[i];
    typename Triangulation::Locate_type type;
    int index = 0;
    if (hint == Face() || !this->IsInside(hint, sighting.pixel))
    {
      hint = this->Delaunay.locate(sighting.pixel, type, index, hint);
    }
    if (!this->Delaunay.is_infinite(hint))
    {
      const int candidate = static_cast<int>(this->Candidates.size());
      this->Candidates.push_back(
        { sighting.pixel, sighting.disparity, 0.0, -1, static_cast<int>(i) });
      this->PutInto(hint, candidate);
    }
  }
}

// Removes all candidates from the star's triangles, except the inserted one.
template <typename Triangulation>
void DisparitySurface<Triangulation>::TakeCandidates(int inserted)
{
  this->Homeless.clear();
  for (const Face face : this->Star)
  {
    FaceInfo& info = face->info();
    for (int c = info.firstCandidate; c >= 0; c = this->Candidates[c].next)
    {
      if (c != inserted)
      {
        this->Homeless.push_back(c);
      }
    }
    info.firstCandidate = -1;
    info.changed = ++this->Changes;
  }
}

// The triangles incident to a vertex, counter-clockwise, infinite ones included.
template <typename Triangulation>
void DisparitySurface<Triangulation>::FindStar(Vertex center)
{
  this->Star.clear();
  auto face = this->Delaunay.incident_faces(center);
  const auto first = face;
  do
  {
    this->Star.push_back(face);
  } while (++face != first);
}

// Distributes candidates among the triangles incident to a new vertex. These fill the hole that its
// insertion made, and each has an angle of less than 180 degrees at the vertex: its two edges there
// decide whether a point is inside.
template <typename Triangulation>
void DisparitySurface<Triangulation>::Redistribute(Vertex center)
{
  const std::vector<Face>& star = this->Star;
  std::size_t guess = 0;
  for (const int candidate : this->Homeless)
  {
    const Pixel& pixel = this->Candidates[candidate].pixel;
    for (std::size_t tried = 0; tried < star.size(); ++tried, guess = (guess + 1) % star.size())
    {
      const Face face = star[guess];
      const int at = face->index(center);
      const Pixel& first = face->vertex(Triangulation::ccw(at))->point();
      const Pixel& second = face->vertex(Triangulation::cw(at))->point();
      if (CGAL::orientation(center->point(), first, pixel) != CGAL::RIGHT_TURN &&
        CGAL::orientation(center->point(), second, pixel) != CGAL::LEFT_TURN)
      {
        break;
      }
    }
    this->PutInto(star[guess], candidate);
  }
  for (const Face face : star)
  {
    this->Enqueue(face);
  }
}

template <typename Triangulation>
void DisparitySurface<Triangulation>::Insert(int candidate, Face face)
{
  const SightedFeature& given = this->Given[this->Candidates[candidate].given];
  const SightedPoint sighting{ given, given.feature->point, given.feature->sourceView };
  typename Triangulation::Locate_type type;
  int index = 0;
  face = this->Delaunay.locate(sighting.pixel, type, index, face);
  Vertex vertex;
  if (type == Triangulation::VERTEX)
  {
    // It replaces the point at the same pixel: the same triangles, with a greater disparity.
    vertex = face->vertex(index);
    this->Points[vertex->info().point] = sighting;
    vertex->info().disparity = sighting.disparity;
  }
  else
  {
    vertex = this->Delaunay.insert(sighting.pixel, type, face, index);
    vertex->info() = { static_cast<int>(this->Points.size()), sighting.disparity };
    this->Points.push_back(sighting);
  }
  // All triangles that were in conflict with the point are now incident to it, with other vertices
  // but the same lists; on the hull, one may have become infinite.
  this->FindStar(vertex);
  this->TakeCandidates(candidate);
  this->Star.erase(std::remove_if(this->Star.begin(), this->Star.end(),
                     [this](Face around) { return this->Delaunay.is_infinite(around); }),
    this->Star.end());
  this->Redistribute(vertex);
}

template <typename Triangulation>
void DisparitySurface<Triangulation>::EnforceMinimumDisparity(
  double tolerance, const CancellationFlag& stop)
{
  this->Tolerance = tolerance;
  for (const Face face : this->Delaunay.finite_face_handles())
  {
    this->Enqueue(face);
  }
  this->InsertHighest(stop);
}

// Inserts the candidates in the queue, and those that become too high thereby.
template <typename Triangulation>
void DisparitySurface<Triangulation>::InsertHighest(const CancellationFlag& stop)
{
  while (!this->Queue.empty())
  {
    ThrowIfCancelled(stop);
    const Highest highest = this->Queue.top();
    this->Queue.pop();
    if (highest.changed == highest.face->info().changed)
    {
      this->Insert(highest.candidate, highest.face);
    }
  }
}

template <typename Triangulation>
void DisparitySurface<Triangulation>::Fill(DisparityMap& map) const
{
  map.points.reserve(this->Points.size());
  map.imagePoints.reserve(this->Points.size());
  map.sourceView.reserve(this->Points.size());
  map.triangles.reserve(this->Delaunay.number_of_faces());
  for (const SightedPoint& sighting : this->Points)
  {
    map.points.push_back(sighting.point);
    map.imagePoints.emplace_back(sighting.pixel.x(), sighting.pixel.y());
    map.sourceView.push_back(sighting.sourceView);
    map.deviations.push_back(sighting.deviation);
  }
  const auto isUnknown = [](double deviation) { return deviation == 0; };
  if (std::all_of(map.deviations.begin(), map.deviations.end(), isUnknown))
  {
    map.deviations.clear();
  }
  for (const Face face : this->Delaunay.finite_face_handles())
  {
    map.triangles.push_back({ face->vertex(0)->info().point, face->vertex(1)->info().point,
      face->vertex(2)->info().point });
  }
}

template class DisparitySurface<PlainTriangulation>;
template class DisparitySurface<ConstrainedTriangulation>;

}
