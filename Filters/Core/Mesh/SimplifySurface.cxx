// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SimplifySurface.h"

#include "Common/Error.h"
#include "Mesh/TriangleIntersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_map>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

void SimplifyOptions::Check() const
{
  if (!(this->bound > 0 && std::isfinite(this->bound)))
  {
    throw Error("The bound of the simplification is " + std::to_string(this->bound) +
      ", it must be a length above 0.");
  }
}

namespace
{

namespace SMS = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using VertexIndex = Mesh::Vertex_index;
using FaceIndex = Mesh::Face_index;
using EdgeFlags = Mesh::Property_map<Mesh::Edge_index, bool>;
using VertexFlags = Mesh::Property_map<VertexIndex, bool>;
using FaceErrors = Mesh::Property_map<FaceIndex, double>;
using FaceLabels = Mesh::Property_map<FaceIndex, std::int64_t>;

/// Between two looks at the progress.
constexpr std::size_t StepsAtATime = 512;

/// A new triangle's least height over its longest side, as a share of that side.
constexpr double LeastHeight = 1e-3;

/// All triangles lean less than so against the plane that they are compared over (the cosine).
constexpr double LeastCosine = 0.2;

/// So often the surface is simplified again around where it met itself.
constexpr int MostRounds = 6;

Vector3d VectorOf(const Kernel::Point_3& p)
{
  return Vector3d(p.x(), p.y(), p.z());
}

Vector3d Normal(const std::array<Vector3d, 3>& t)
{
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

/// Patches of triangles as heights over a plane.
class Comparison
{
public:
  using Triangles = std::vector<std::array<Vector3d, 3>>;
  struct Segment
  {
    Vector3d from, to;
  };

  /// False when a triangle leans too much.
  bool Begin(const Triangles& before, const Triangles& after)
  {
    Vector3d sum = Vector3d::Zero();
    for (const auto& t : before)
    {
      sum += Normal(t);
    }
    this->Up = sum.normalized();
    this->U = this->Up.unitOrthogonal();
    this->V = this->Up.cross(this->U);
    for (const Triangles* triangles : { &before, &after })
    {
      for (const auto& t : *triangles)
      {
        const Vector3d normal = Normal(t);
        if (!(normal.dot(this->Up) > LeastCosine * normal.norm()))
        {
          return false;
        }
      }
    }
    return true;
  }

  Vector3d Local(const Vector3d& p) const
  {
    return Vector3d(this->U.dot(p), this->V.dot(p), this->Up.dot(p));
  }

  /// Whether the triangles around a point go around it once.
  bool GoAroundOnce(const Triangles& fan, const Vector3d& center) const
  {
    double turn = 0.0;
    const Vector2d c = this->Local(center).head<2>();
    for (const auto& t : fan)
    {
      const int at = t[0] == center ? 0 : t[1] == center ? 1 : 2;
      const Vector2d a = this->Local(t[(at + 1) % 3]).head<2>() - c;
      const Vector2d b = this->Local(t[(at + 2) % 3]).head<2>() - c;
      turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    return std::abs(turn - 2 * M_PI) < 1e-6;
  }

  /// How far a point is from the triangles, upwards or downwards.
  double HeightAbove(const Triangles& triangles, const Vector3d& point) const
  {
    const Vector3d p = this->Local(point);
    double best = -HUGE_VAL, height = HUGE_VAL;
    for (const auto& t : triangles)
    {
      const Vector3d a = this->Local(t[0]), b = this->Local(t[1]), c = this->Local(t[2]);
      const double area = Turn(a, b, c);
      const double wa = Turn(p, b, c) / area, wb = Turn(a, p, c) / area;
      const double inside = std::min({ wa, wb, 1 - wa - wb });
      if (inside > best)
      {
        best = inside;
        height = std::abs(p.z() - (wa * a.z() + wb * b.z() + (1 - wa - wb) * c.z()));
      }
    }
    return height;
  }

  /// How far two segments are apart where they cross; 0 when they do not.
  double GapAtCrossing(const Segment& s, const Segment& t) const
  {
    const Vector3d a = this->Local(s.from), b = this->Local(s.to);
    const Vector3d c = this->Local(t.from), d = this->Local(t.to);
    const double ca = Turn(c, d, a), cb = Turn(c, d, b), ac = Turn(a, b, c), ad = Turn(a, b, d);
    if (!(ca * cb < 0 && ac * ad < 0))
    {
      return 0.0;
    }
    const double onS = ca / (ca - cb), onT = ac / (ac - ad);
    return std::abs(a.z() + onS * (b.z() - a.z()) - c.z() - onT * (d.z() - c.z()));
  }

private:
  static double Turn(const Vector3d& a, const Vector3d& b, const Vector3d& c)
  {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }

  Vector3d Up, U, V;
};

/// What the collapses share.
struct State
{
  double bound;
  FaceErrors errors;
  VertexFlags isFixed;
  double error = 0.0; ///< of the triangles about to come
  const Progress* progress;
  std::size_t steps = 0;
};

/// Lets through the collapses that keep within the bound.
struct WithinBound
{
  State* state;

  template <typename Profile>
  boost::optional<typename Profile::Point> operator()(
    const Profile& profile, boost::optional<typename Profile::Point> placement) const
  {
    return placement && this->Check(profile, *placement) ? placement : boost::none;
  }

  template <typename Profile>
  bool Check(const Profile& profile, const Kernel::Point_3& placement) const
  {
    const Mesh& mesh = profile.surface_mesh();
    const bool fixed0 = this->state->isFixed[profile.v0()];
    const bool fixed1 = this->state->isFixed[profile.v1()];
    if ((fixed0 && placement != profile.p0()) || (fixed1 && placement != profile.p1()))
    {
      return false;
    }
    double before = 0.0;
    for (VertexIndex end : { profile.v0(), profile.v1() })
    {
      for (FaceIndex face : CGAL::faces_around_target(mesh.halfedge(end), mesh))
      {
        if (face == Mesh::null_face())
        {
          return false;
        }
        before = std::max(before, this->state->errors[face]);
      }
    }
    Comparison::Triangles oldTriangles, newTriangles;
    std::vector<Comparison::Segment> oldEdges, newEdges;
    const Vector3d p = VectorOf(placement);
    this->Collect(profile, p, oldTriangles, newTriangles, oldEdges, newEdges);
    Comparison comparison;
    if (before >= this->state->bound || !HaveShape(newTriangles) ||
      !comparison.Begin(oldTriangles, newTriangles) || !comparison.GoAroundOnce(newTriangles, p))
    {
      return false;
    }
    double apart = std::max({ comparison.HeightAbove(oldTriangles, p),
      comparison.HeightAbove(newTriangles, VectorOf(profile.p0())),
      comparison.HeightAbove(newTriangles, VectorOf(profile.p1())) });
    for (const Comparison::Segment& oldEdge : oldEdges)
    {
      for (const Comparison::Segment& newEdge : newEdges)
      {
        apart = std::max(apart, comparison.GapAtCrossing(oldEdge, newEdge));
      }
    }
    this->state->error = before + apart;
    return this->state->error <= this->state->bound;
  }

  template <typename Profile>
  void Collect(const Profile& profile, const Vector3d& p, Comparison::Triangles& oldTriangles,
    Comparison::Triangles& newTriangles, std::vector<Comparison::Segment>& oldEdges,
    std::vector<Comparison::Segment>& newEdges) const
  {
    const Mesh& mesh = profile.surface_mesh();
    const auto isEnd = [&](VertexIndex v) { return v == profile.v0() || v == profile.v1(); };
    for (const auto& triangle : profile.triangles())
    {
      const VertexIndex corners[3] = { triangle.v0, triangle.v1, triangle.v2 };
      std::array<Vector3d, 3> place;
      int ends = 0, end = 0;
      for (int i = 0; i < 3; ++i)
      {
        place[i] = VectorOf(mesh.point(corners[i]));
        ends += isEnd(corners[i]);
        end = isEnd(corners[i]) ? i : end;
      }
      oldTriangles.push_back(place);
      oldEdges.push_back({ place[end], place[(end + 1) % 3] });
      if (ends == 1)
      {
        place[end] = p;
        newTriangles.push_back(place);
        newEdges.push_back({ p, place[(end + 1) % 3] });
      }
      else
      {
        oldEdges.push_back({ place[end], place[(end + 2) % 3] });
        oldEdges.push_back({ place[(end + 1) % 3], place[(end + 2) % 3] });
      }
    }
  }

  static bool HaveShape(const Comparison::Triangles& triangles)
  {
    return std::all_of(triangles.begin(), triangles.end(),
      [](const std::array<Vector3d, 3>& t)
      {
        const double longest = std::max({ (t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(),
          (t[0] - t[2]).squaredNorm() });
        return Normal(t).norm() > LeastHeight * longest;
      });
  }
};

/// The library's placement, as the result will hold it.
struct RoundedPlacement
{
  bool isSingle;
  SMS::LindstromTurk_placement<Mesh> placement;

  template <typename Profile>
  boost::optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    const auto exact = this->placement(profile);
    if (!exact || !this->isSingle)
    {
      return exact;
    }
    // In memory, since GCC 12 leaves out a conversion to single precision and back.
    volatile float p[3] = { static_cast<float>(exact->x()), static_cast<float>(exact->y()),
      static_cast<float>(exact->z()) };
    return Kernel::Point_3(p[0], p[1], p[2]);
  }
};

struct Watcher : SMS::Edge_collapse_visitor_base<Mesh>
{
  State* state;

  explicit Watcher(State* s)
    : state(s)
  {
  }

  void OnSelected(
    const Profile&, const boost::optional<double>&, std::size_t initial, std::size_t current)
  {
    if (++this->state->steps % StepsAtATime == 0)
    {
      (*this->state->progress)(1.0 - static_cast<double>(current) / initial);
    }
  }

  void OnCollapsed(const Profile& profile, VertexIndex vertex)
  {
    for (FaceIndex face :
      CGAL::faces_around_target(profile.surface_mesh().halfedge(vertex), profile.surface_mesh()))
    {
      this->state->errors[face] = this->state->error;
    }
  }
};

struct Never
{
  template <typename Cost, typename Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t) const
  {
    return false;
  }
};

class Simplifier
{
public:
  Simplifier(const LabelledSurface& surface, const SimplifyOptions& options)
    : Surface(surface)
    , Options(options)
    , Kept(surface.points.size(), 0)
  {
  }

  LabelledSurface Run(const Progress& progress, const ParallelFor& parallelFor)
  {
    for (int round = 0; round < MostRounds; ++round)
    {
      // Rounds are rare.
      LabelledSurface result =
        this->Collapse(progress.Part(round == 0 ? 0.0 : 0.9, round == 0 ? 0.9 : 1.0));
      const auto meetings = FindMeetings(result, parallelFor);
      // What met itself before has no claim.
      if (meetings.empty() || (round == 0 && !FindMeetings(this->Surface, parallelFor).empty()))
      {
        progress(1.0);
        return result;
      }
      this->KeepAround(result, meetings);
    }
    return this->Surface;
  }

private:
  LabelledSurface Collapse(const Progress& progress) const
  {
    Mesh mesh;
    FaceLabels labels = mesh.add_property_map<FaceIndex, std::int64_t>("f:label", 0).first;
    this->Fill(mesh, labels);
    EdgeFlags isConstrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:fixed", false).first;
    State state;
    state.bound = this->Options.bound;
    state.errors = mesh.add_property_map<FaceIndex, double>("f:error", 0.0).first;
    state.isFixed = mesh.add_property_map<VertexIndex, bool>("v:fixed", false).first;
    state.progress = &progress;
    this->Constrain(mesh, labels, isConstrained, state.isFixed);
    const RoundedPlacement placement = { this->Options.isSingle, {} };
    SMS::edge_collapse(mesh, Never(),
      CGAL::parameters::edge_is_constrained_map(isConstrained)
        .get_cost(SMS::LindstromTurk_cost<Mesh>())
        .get_placement(
          SMS::Constrained_placement<RoundedPlacement, EdgeFlags>(isConstrained, placement))
        .filter(WithinBound{ &state })
        .visitor(Watcher(&state)));
    return Extract(mesh, labels);
  }

  void Fill(Mesh& mesh, FaceLabels& labels) const
  {
    mesh.reserve(this->Surface.points.size(), 3 * this->Surface.triangles.size() / 2,
      this->Surface.triangles.size());
    for (const Vector3d& p : this->Surface.points)
    {
      mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
    }
    for (std::size_t t = 0; t < this->Surface.triangles.size(); ++t)
    {
      const auto& corners = this->Surface.triangles[t];
      const FaceIndex face =
        mesh.add_face(VertexIndex(corners[0]), VertexIndex(corners[1]), VertexIndex(corners[2]));
      if (face == Mesh::null_face())
      {
        throw Error("The surface is not a 2-manifold at triangle " + std::to_string(t) +
          ", it cannot be simplified.");
      }
      labels[face] = this->Surface.labels.empty() ? 0 : this->Surface.labels[t];
    }
  }

  void Constrain(
    const Mesh& mesh, const FaceLabels& labels, EdgeFlags& edges, VertexFlags& vertices) const
  {
    for (Mesh::Edge_index edge : mesh.edges())
    {
      const auto half = mesh.halfedge(edge);
      const VertexIndex from = mesh.source(half), to = mesh.target(half);
      const bool isBetween =
        mesh.is_border(edge) || labels[mesh.face(half)] != labels[mesh.face(mesh.opposite(half))];
      if (isBetween || (this->Kept[from.idx()] && this->Kept[to.idx()]))
      {
        edges[edge] = vertices[from] = vertices[to] = true;
      }
    }
  }

  static LabelledSurface Extract(const Mesh& mesh, const FaceLabels& labels)
  {
    LabelledSurface result;
    std::vector<std::int32_t> place(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
    for (VertexIndex vertex : mesh.vertices())
    {
      if (!mesh.is_isolated(vertex))
      {
        place[vertex.idx()] = static_cast<std::int32_t>(result.points.size());
        result.points.push_back(VectorOf(mesh.point(vertex)));
      }
    }
    for (FaceIndex face : mesh.faces())
    {
      std::array<std::int32_t, 3> corners;
      auto corner = corners.begin();
      for (VertexIndex vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      {
        *corner++ = place[vertex.idx()];
      }
      result.triangles.push_back(corners);
      result.labels.push_back(labels[face]);
    }
    return result;
  }

  using Meetings = std::vector<std::pair<std::size_t, std::size_t>>;

  static Meetings FindMeetings(const LabelledSurface& surface, const ParallelFor& parallelFor)
  {
    const TriangleSoup soup = { [&](std::int32_t v) { return surface.points[v]; },
      surface.triangles.empty() ? nullptr : surface.triangles[0].data(), surface.triangles.size() };
    std::vector<std::size_t> all(surface.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    return FindIntersections(
      soup, all, 2 * MeanSide(surface), [](std::size_t, std::size_t) { return true; }, parallelFor);
  }

  /// Keeps the original vertices around where the result meets itself.
  void KeepAround(const LabelledSurface& result, const Meetings& meetings)
  {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const auto& meeting : meetings)
    {
      for (std::size_t t : { meeting.first, meeting.second })
      {
        Eigen::AlignedBox3d box;
        for (std::int32_t corner : result.triangles[t])
        {
          box.extend(result.points[corner]);
        }
        const Vector3d room = Vector3d::Constant(2 * this->Options.bound);
        boxes.emplace_back(box.min() - room, box.max() + room);
      }
    }
    for (std::size_t v = 0; v < this->Surface.points.size(); ++v)
    {
      this->Kept[v] = this->Kept[v] ||
        std::any_of(boxes.begin(), boxes.end(),
          [&](const Eigen::AlignedBox3d& box) { return box.contains(this->Surface.points[v]); });
    }
  }

  static double MeanSide(const LabelledSurface& surface)
  {
    double sum = 0.0;
    for (const auto& t : surface.triangles)
    {
      sum += (surface.points[t[1]] - surface.points[t[0]]).norm();
    }
    return surface.triangles.empty() ? 1.0 : sum / surface.triangles.size();
  }

  const LabelledSurface& Surface;
  const SimplifyOptions Options;
  std::vector<char> Kept; ///< vertices that must stay
};

}

LabelledSurface SimplifySurface(const LabelledSurface& surface, const SimplifyOptions& options,
  const Progress& progress, const ParallelFor& parallelFor)
{
  options.Check();
  for (const Vector3d& p : surface.points)
  {
    if (!p.allFinite())
    {
      throw Error("The surface has a point that is not finite.");
    }
  }
  progress(0.0);
  return Simplifier(surface, options).Run(progress, parallelFor);
}

}
