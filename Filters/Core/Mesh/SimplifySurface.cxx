// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SimplifySurface.h"

#include "Common/Error.h"
#include "Mesh/PatchComparison.h"
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
#include <optional>
#include <string>
#include <unordered_map>

namespace freespace
{

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

// CGAL 6 took the standard library's.
#if CGAL_VERSION_MAJOR >= 6
template <typename Value>
using Optional = std::optional<Value>;
#else
template <typename Value>
using Optional = boost::optional<Value>;
#endif

/// Collapses between two reports of the progress.
constexpr std::size_t StepsAtATime = 512;

/// Greatest number of repetitions around self-intersections.
constexpr int MostRounds = 6;

Vector3d VectorOf(const Kernel::Point_3& p)
{
  return Vector3d(p.x(), p.y(), p.z());
}

/// State shared by the policies.
struct State
{
  double bound;
  FaceErrors errors;
  VertexFlags isFixed;
  double error = 0.0; ///< of the triangles of the next collapse
  const Progress* progress;
  std::size_t steps = 0;
};

/// Filters the collapses: those within the bound.
struct WithinBound
{
  State* state;

  template <typename Profile>
  Optional<typename Profile::Point> operator()(
    const Profile& profile, Optional<typename Profile::Point> placement) const
  {
    return placement && this->Check(profile, *placement) ? placement
                                                         : Optional<typename Profile::Point>();
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
    PatchComparison::Triangles oldTriangles, newTriangles;
    std::vector<PatchComparison::Segment> oldEdges, newEdges;
    const Vector3d p = VectorOf(placement);
    this->Collect(profile, p, oldTriangles, newTriangles, oldEdges, newEdges);
    PatchComparison comparison;
    if (before >= this->state->bound || !PatchComparison::HaveShape(newTriangles) ||
      !comparison.Begin(oldTriangles, newTriangles) || !comparison.GoAroundOnce(newTriangles, p))
    {
      return false;
    }
    double apart = std::max({ comparison.HeightAbove(oldTriangles, p),
      comparison.HeightAbove(newTriangles, VectorOf(profile.p0())),
      comparison.HeightAbove(newTriangles, VectorOf(profile.p1())) });
    for (const PatchComparison::Segment& oldEdge : oldEdges)
    {
      for (const PatchComparison::Segment& newEdge : newEdges)
      {
        apart = std::max(apart, comparison.GapAtCrossing(oldEdge, newEdge));
      }
    }
    this->state->error = before + apart;
    return this->state->error <= this->state->bound;
  }

  template <typename Profile>
  void Collect(const Profile& profile, const Vector3d& p, PatchComparison::Triangles& oldTriangles,
    PatchComparison::Triangles& newTriangles, std::vector<PatchComparison::Segment>& oldEdges,
    std::vector<PatchComparison::Segment>& newEdges) const
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
};

/// The library's placement, rounded to the precision of the result.
struct RoundedPlacement
{
  bool isSingle;
  SMS::LindstromTurk_placement<Mesh> placement;

  template <typename Profile>
  Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    auto exact = this->placement(profile);
    if (!exact || !this->isSingle)
    {
      return exact;
    }
    // In memory, as GCC 12 omits a conversion to single precision and back.
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

  void OnSelected(const Profile&, const Optional<double>&, std::size_t initial, std::size_t current)
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

  LabelledSurface Run(const Progress& progress, const ParallelFor& parallelFor);

private:
  LabelledSurface Collapse(const Progress& progress) const;
  void Fill(Mesh& mesh, FaceLabels& labels) const;
  void Constrain(
    const Mesh& mesh, const FaceLabels& labels, EdgeFlags& edges, VertexFlags& vertices) const;
  static LabelledSurface Extract(const Mesh& mesh, const FaceLabels& labels);
  using Meetings = std::vector<std::pair<std::size_t, std::size_t>>;

  static Meetings FindMeetings(const LabelledSurface& surface, const ParallelFor& parallelFor);
  void KeepAround(const LabelledSurface& result, const Meetings& meetings);
  static double MeanSide(const LabelledSurface& surface);
  const LabelledSurface& Surface;
  const SimplifyOptions Options;
  std::vector<char> Kept; ///< vertices that must stay
};

LabelledSurface Simplifier::Run(const Progress& progress, const ParallelFor& parallelFor)
{
  for (int round = 0; round < MostRounds; ++round)
  {
    // Further rounds are rare.
    LabelledSurface result =
      this->Collapse(progress.Part(round == 0 ? 0.0 : 0.9, round == 0 ? 0.9 : 1.0));
    const auto meetings = FindMeetings(result, parallelFor);
    // A surface that intersected itself before may do so afterwards.
    if (meetings.empty() || (round == 0 && !FindMeetings(this->Surface, parallelFor).empty()))
    {
      progress(1.0);
      return result;
    }
    this->KeepAround(result, meetings);
  }
  return this->Surface;
}

LabelledSurface Simplifier::Collapse(const Progress& progress) const
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

void Simplifier::Fill(Mesh& mesh, FaceLabels& labels) const
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

void Simplifier::Constrain(
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

LabelledSurface Simplifier::Extract(const Mesh& mesh, const FaceLabels& labels)
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

Simplifier::Meetings Simplifier::FindMeetings(
  const LabelledSurface& surface, const ParallelFor& parallelFor)
{
  const TriangleSoup soup = { [&](std::int32_t v) { return surface.points[v]; },
    surface.triangles.empty() ? nullptr : surface.triangles[0].data(), surface.triangles.size() };
  std::vector<std::size_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return FindIntersections(
    soup, all, 2 * MeanSide(surface), [](std::size_t, std::size_t) { return true; }, parallelFor);
}

// Keeps the original vertices around self-intersections of the result.
void Simplifier::KeepAround(const LabelledSurface& result, const Meetings& meetings)
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

double Simplifier::MeanSide(const LabelledSurface& surface)
{
  double sum = 0.0;
  for (const auto& t : surface.triangles)
  {
    sum += (surface.points[t[1]] - surface.points[t[0]]).norm();
  }
  return surface.triangles.empty() ? 1.0 : sum / surface.triangles.size();
}

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
