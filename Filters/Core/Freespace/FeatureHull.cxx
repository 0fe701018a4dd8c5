// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FeatureHull.h"

#include "Common/Octant.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace freespace
{

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Plane
{
  Vector3d normal;
  double offset;
};

// Faces, edges and corners of a cube.
Points CubeDirections()
{
  Points directions;
  for (int i = 0; i < 27; ++i)
  {
    const Vector3d d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i != 13)
    {
      directions.push_back(d.normalized());
    }
  }
  return directions;
}

const Vector3d& Extreme(const Points& points, const Vector3d& direction)
{
  return *std::max_element(points.begin(), points.end(),
    [&](const Vector3d& a, const Vector3d& b) { return direction.dot(a) < direction.dot(b); });
}

double Support(const Points& points, const Vector3d& direction)
{
  double greatest = -HUGE_VAL;
  for (const Vector3d& point : points)
  {
    greatest = std::max(greatest, direction.dot(point));
  }
  return greatest;
}

Plane PlaneThrough(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const double length = normal.norm();
  const Vector3d unit = length > 0 ? Vector3d(normal / length) : Vector3d(0, 0, 0);
  return { unit, unit.dot(a) };
}

// Whether the points span a volume. Where they do not, their plane (zero normal: not even a plane).
bool SpanVolume(const Points& points, double tolerance, Plane& plane)
{
  const Vector3d& a = points.front();
  const auto furthest = [&points](auto&& distance)
  {
    return *std::max_element(points.begin(), points.end(),
      [&](const Vector3d& p, const Vector3d& q) { return distance(p) < distance(q); });
  };
  const Vector3d b = furthest([&](const Vector3d& p) { return (p - a).norm(); });
  const Vector3d line = (b - a).normalized();
  const auto offLine = [&](const Vector3d& p) { return (p - a).cross(line).norm(); };
  const Vector3d c = furthest(offLine);
  plane = { Vector3d::Zero(), 0.0 };
  if (!(offLine(c) > tolerance))
  {
    return false;
  }
  plane = PlaneThrough(a, b, c);
  const auto offPlane = [&](const Vector3d& p)
  { return std::abs(plane.normal.dot(p) - plane.offset); };
  return offPlane(furthest(offPlane)) > tolerance;
}

bool IsBefore(const Vector3d& a, const Vector3d& b)
{
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

// The planes of facets, of whose order nothing depends: those that another hull has, too, are exactly the same there.
std::vector<Plane> PlanesOf(std::vector<std::array<Vector3d, 3>> facets)
{
  for (std::array<Vector3d, 3>& facet : facets)
  {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end(), IsBefore), facet.end());
  }
  std::sort(facets.begin(), facets.end(),
    [](const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b)
    { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), IsBefore); });
  std::vector<Plane> planes;
  for (const std::array<Vector3d, 3>& facet : facets)
  {
    planes.push_back(PlaneThrough(facet[0], facet[1], facet[2]));
  }
  return planes;
}

std::vector<Plane> FacetPlanes(const Points& points, Points& corners)
{
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Vector3d& p : points)
  {
    input.emplace_back(p.x(), p.y(), p.z());
  }
  Mesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  const auto position = [&mesh](Mesh::Vertex_index v)
  {
    const auto& p = mesh.point(v);
    return Vector3d(p.x(), p.y(), p.z());
  };
  for (Mesh::Vertex_index v : mesh.vertices())
  {
    corners.push_back(position(v));
  }
  std::vector<std::array<Vector3d, 3>> facets;
  for (Mesh::Face_index f : mesh.faces())
  {
    const auto h = mesh.halfedge(f);
    facets.push_back(
      { position(mesh.source(h)), position(mesh.target(h)), position(mesh.target(mesh.next(h))) });
  }
  return PlanesOf(std::move(facets));
}

// Points well inside the hull of a few extreme points cannot be corners of the whole hull. Leaving
// them out first makes the hull of hundreds of thousands of features a matter of a few thousand.
Points DropInner(const Points& points, double tolerance, int rings, const CancellationFlag& stop)
{
  Points extremes;
  for (int i = 0; i < rings * rings; ++i)
  {
    ThrowIfCancelled(stop);
    // Fibonacci directions over the sphere.
    const double z = 1.0 - (2.0 * i + 1.0) / (rings * rings);
    const double angle = i * M_PI * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    extremes.push_back(Extreme(points, { r * std::cos(angle), r * std::sin(angle), z }));
  }
  Plane plane;
  if (!SpanVolume(extremes, tolerance, plane))
  {
    return points;
  }
  Points corners;
  const std::vector<Plane> planes = FacetPlanes(extremes, corners);
  Points kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept),
    [&](const Vector3d& p)
    {
      return std::any_of(planes.begin(), planes.end(),
        [&](const Plane& f) { return f.normal.dot(p) - f.offset > -tolerance; });
    });
  return kept;
}

// What counts as nothing among points in a box.
double Tolerance(const Eigen::AlignedBox3d& box)
{
  return 1e-12 * (box.diagonal().norm() + box.center().norm());
}

// A flat hull: its plane from both sides, and the lines of its edges within the plane.
std::vector<Plane> FlatPlanes(const Points& points, const Plane& plane)
{
  std::vector<Plane> planes = { plane, { -plane.normal, -plane.offset } };
  const Vector3d u = plane.normal.unitOrthogonal();
  const Vector3d v = plane.normal.cross(u);
  std::vector<Kernel::Point_2> flat;
  for (const Vector3d& p : points)
  {
    flat.emplace_back(u.dot(p), v.dot(p));
  }
  std::vector<Kernel::Point_2> corners;
  CGAL::convex_hull_2(flat.begin(), flat.end(), std::back_inserter(corners));
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const auto side = corners[(i + 1) % corners.size()] - corners[i];
    planes.push_back({ (side.y() * u - side.x() * v).normalized(), 0.0 });
  }
  return planes;
}

}

Points FeatureHull::OuterPoints(const Points& points, const CancellationFlag& stop)
{
  if (points.size() <= 1000)
  {
    return points;
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points)
  {
    box.extend(p);
  }
  // Few directions first, so that the many are evaluated for few points only.
  return DropInner(DropInner(points, Tolerance(box), 5, stop), Tolerance(box), 16, stop);
}

FeatureHull::FeatureHull(const Points& points, double margin, const CancellationFlag& stop)
{
  Points finite;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points)
  {
    if (p.allFinite())
    {
      finite.push_back(p);
      box.extend(p);
    }
  }
  if (finite.empty())
  {
    return;
  }
  const Points outer = OuterPoints(finite, stop);
  Points corners;
  std::vector<Plane> planes;
  Plane flat;
  if (SpanVolume(outer, Tolerance(box), flat))
  {
    planes = FacetPlanes(outer, corners);
  }
  else
  {
    corners = outer;
    planes = flat.normal.isZero() ? std::vector<Plane>() : FlatPlanes(outer, flat);
  }
  for (const Vector3d& direction : CubeDirections())
  {
    planes.push_back({ direction, 0.0 });
  }
  planes.erase(std::remove_if(planes.begin(), planes.end(),
                 [](const Plane& plane) { return plane.normal.squaredNorm() < 0.5; }),
    planes.end());
  this->Normals.resize(3, static_cast<Eigen::Index>(planes.size()));
  this->Offsets.resize(static_cast<Eigen::Index>(planes.size()));
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    ThrowIfCancelled(stop);
    // The offset from all corners, not from the facet's own: no rounding may cut off a feature.
    this->Normals.col(i) = planes[i].normal;
    this->Offsets[i] = Support(corners, planes[i].normal) + margin;
  }
  this->Box = Eigen::AlignedBox3d(
    box.min() - Vector3d::Constant(margin), box.max() + Vector3d::Constant(margin));
}

int FeatureHull::NearestPlane(const Vector3d& point) const
{
  if (!this->Box.contains(point))
  {
    return this->NearestOfAll(point);
  }
  std::call_once(this->IsSplit,
    [this]
    {
      this->Nodes.emplace_back();
      this->Nodes[0].planes.resize(this->NumberOfPlanes());
      std::iota(this->Nodes[0].planes.begin(), this->Nodes[0].planes.end(), 0);
      this->Split(0, this->Box, 0);
    });
  Eigen::AlignedBox3d box = this->Box;
  int node = 0;
  while (this->Nodes[node].first >= 0)
  {
    const int child = OctantOf(box, point);
    box = Octant(box, child);
    node = this->Nodes[node].first + child;
  }
  const std::vector<int>& planes = this->Nodes[node].planes;
  return *std::max_element(planes.begin(), planes.end(),
    [&](int a, int b) { return this->Distance(a, point) < this->Distance(b, point); });
}

void FeatureHull::Split(int node, const Eigen::AlignedBox3d& box, int depth) const
{
  constexpr std::size_t Few = 6;
  constexpr int Deepest = 5;
  if (this->Nodes[node].planes.size() <= Few || depth == Deepest)
  {
    return;
  }
  const int first = static_cast<int>(this->Nodes.size());
  this->Nodes[node].first = first;
  this->Nodes.resize(first + 8);
  const std::vector<int> planes = std::move(this->Nodes[node].planes);
  for (int child = 0; child < 8; ++child)
  {
    const Eigen::AlignedBox3d part = Octant(box, child);
    this->Nodes[first + child].planes = this->Nearest(part, planes);
    this->Split(first + child, part, depth + 1);
  }
}

// Those planes that can be the nearest somewhere in a box: a plane that lies further at all eight
// corners than one other plane does so everywhere between. Only the corners' nearest are tried as
// such others.
std::vector<int> FeatureHull::Nearest(
  const Eigen::AlignedBox3d& box, const std::vector<int>& planes) const
{
  using Corners = Eigen::Array<double, 8, 1>;
  const double room = 1e-9 * box.diagonal().norm();
  std::vector<Corners> distances(planes.size());
  std::array<std::size_t, 8> nearest = {};
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      distances[i][corner] =
        this->Distance(planes[i], box.corner(Eigen::AlignedBox3d::CornerType(corner)));
      nearest[corner] =
        distances[i][corner] > distances[nearest[corner]][corner] ? i : nearest[corner];
    }
  }
  std::vector<int> kept;
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    const bool never = std::any_of(nearest.begin(), nearest.end(),
      [&](std::size_t other) { return (distances[i] + room < distances[other]).all(); });
    if (!never)
    {
      kept.push_back(planes[i]);
    }
  }
  return kept;
}

int FeatureHull::NearestOfAll(const Vector3d& point) const
{
  int nearest = -1;
  double greatest = -HUGE_VAL;
  for (int i = 0; i < this->NumberOfPlanes(); ++i)
  {
    const double distance = this->Distance(i, point);
    if (distance > greatest)
    {
      greatest = distance;
      nearest = i;
    }
  }
  return nearest;
}

BoxContent FeatureHull::Classify(
  const Eigen::AlignedBox3d& box, const std::vector<int>& parent, std::vector<int>& open) const
{
  const Vector3d center = box.center();
  const Vector3d half = 0.5 * box.sizes();
  const double slack = 1e-12 * (center.norm() + half.norm());
  open.clear();
  for (int i : parent)
  {
    const double distance = this->Distance(i, center);
    const double reach = this->Normals.col(i).cwiseAbs().dot(half) + slack;
    if (distance - reach > 0)
    {
      return BoxContent::Free;
    }
    if (distance + reach > 0)
    {
      open.push_back(i);
    }
  }
  return open.empty() ? BoxContent::Matter : BoxContent::Mixed;
}

}
