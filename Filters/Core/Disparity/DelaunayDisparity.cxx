// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/DelaunayDisparity.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Disparity/FeatureCloud.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <type_traits>

namespace freespace
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Pixel = Kernel::Point_2;

// What a triangle knows: the first of the list of candidates that lie in it, and how often it has
// changed, which tells entries of the queue that are out of date.
struct FaceInfo
{
  int firstCandidate = -1;
  unsigned int version = 0;
};

// What a vertex knows of its point: the index, and the disparity, which is asked for all the time.
struct VertexInfo
{
  int point = 0;
  double disparity = 0;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>;
using PlainTriangulation = CGAL::Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
// With edges that it must keep. Those that cross others would need new points: they are left out.
using ConstrainedTriangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<VertexBase,
    CGAL::Constrained_triangulation_face_base_2<Kernel, FaceBase>>,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;

// Where a view sees a point.
struct Sighting
{
  Pixel pixel = Pixel(0, 0);
  double disparity = 0;
};

// A world point as a view sees it.
struct SightedPoint : Sighting
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int sourceView = 0;
};

// The same of another view's feature, of which there are many and few are inserted.
struct SightedFeature : Sighting
{
  const FeatureCloud::Feature* feature = nullptr;
};

// A point that may have to be inserted, linked into the list of its triangle. No more than is looked
// at again and again, and in the order of a space-filling curve: neighbours share the cache.
struct Candidate
{
  Pixel pixel;
  double disparity;
  double height; // above the surface, disparity
  int next;      // in the same triangle
  int given;     // index of the sighting
};

bool Sight(const Camera& camera, const Eigen::Vector3d& point, Sighting& sighting)
{
  const double depth = camera.Depth(point);
  if (!(depth > 0)) // also where it is not a number
  {
    return false;
  }
  const Eigen::Vector2d pixel = camera.Project(point);
  if (!std::isfinite(1 / depth) || !camera.Sees(pixel))
  {
    return false;
  }
  sighting.pixel = Pixel(pixel.x(), pixel.y());
  sighting.disparity = 1 / depth;
  return true;
}

// The lower 16 bits, moved apart to make room for those of another number between them.
std::uint32_t SpreadBits(std::uint32_t x)
{
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

using Key = std::pair<std::uint32_t, std::uint32_t>;

// Sorts keys by their first half, equal ones left in their order: digit by digit from the least one.
void SortByFirst(std::vector<Key>& keys)
{
  constexpr int digits = 3, bits = 11;
  constexpr std::uint32_t mask = (1u << bits) - 1;
  std::vector<Key> sorted(keys.size());
  for (int digit = 0; digit < digits; ++digit)
  {
    const int shift = digit * bits;
    std::vector<std::size_t> next(mask + 2, 0);
    for (const Key& key : keys)
    {
      ++next[(key.first >> shift & mask) + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Key& key : keys)
    {
      sorted[next[key.first >> shift & mask]++] = key;
    }
    keys.swap(sorted);
  }
}

// Indices along a space-filling curve (Morton's), so that each point is found near the one before.
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
  std::vector<Key> keys;
  keys.reserve(sightings.size());
  for (const Sighting& sighting : sightings)
  {
    const auto x = static_cast<std::uint32_t>((sighting.pixel.x() - box.min().x()) * scale);
    const auto y = static_cast<std::uint32_t>((sighting.pixel.y() - box.min().y()) * scale);
    keys.emplace_back(SpreadBits(x) | SpreadBits(y) << 1, static_cast<std::uint32_t>(keys.size()));
  }
  SortByFirst(keys);
  std::vector<std::size_t> order(keys.size());
  std::transform(
    keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

double Cross(const Pixel& a, const Pixel& b, const Pixel& origin)
{
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

// The triangulated disparity surface of one view while it grows.
template <typename Triangulation>
class DisparitySurface
{
  using Face = typename Triangulation::Face_handle;
  using Vertex = typename Triangulation::Vertex_handle;

public:
  explicit DisparitySurface(const View& view)
    : Name(view.name)
  {
  }

  void TriangulateFeatures(const std::vector<SightedPoint>& features, const CancellationFlag& stop);
  void KeepEdges(const std::vector<std::array<int, 2>>& edges);
  void AddCandidates(std::vector<SightedFeature> sightings, const CancellationFlag& stop);
  void EnforceMinimumDisparity(double tolerance, const CancellationFlag& stop);
  void Fill(DisparityMap& map) const;

private:
  // The candidate of a triangle that is highest above it.
  struct Highest
  {
    double height;
    int candidate;
    int given;
    Face face;
    unsigned int version;

    // The queue serves the highest; of equals, the one that was given first.
    bool operator<(const Highest& other) const
    {
      return this->height != other.height ? this->height < other.height : this->given > other.given;
    }
  };

  bool IsInside(Face face, const Pixel& pixel) const;
  double Disparity(Face face, const Pixel& pixel) const;
  void PutInto(Face face, int candidate);
  void Enqueue(Face face);
  void Insert(int candidate, Face face);
  void TakeCandidates(int inserted);
  void FindStar(Vertex center);
  void Redistribute(Vertex center);

  std::string Name;
  std::vector<SightedPoint> Points;  // of the triangulation, by the vertex' info
  std::vector<Vertex> OfFeature;     // where each feature is or was hidden
  std::vector<SightedFeature> Given; // by the other views
  std::vector<Candidate> Candidates;
  Triangulation Delaunay;
  std::priority_queue<Highest> Queue;
  double Tolerance = 0;
  std::vector<Face> Star;    // around the point that is being inserted
  std::vector<int> Homeless; // the candidates that were in it
};

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

// Forces edges between features into the triangulation.
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

// The disparity of the triangle at a pixel inside it.
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

// Enters the triangle's highest candidate that is above the tolerance into the queue.
template <typename Triangulation>
void DisparitySurface<Triangulation>::Enqueue(Face face)
{
  Highest highest{ 0, -1, -1, face, face->info().version };
  for (int c = face->info().firstCandidate; c >= 0; c = this->Candidates[c].next)
  {
    const Candidate& point = this->Candidates[c];
    if (point.height > this->Tolerance * point.disparity)
    {
      const Highest entry{ point.height, c, point.given, face, face->info().version };
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

// Strictly: no other triangle holds the pixel.
template <typename Triangulation>
bool DisparitySurface<Triangulation>::IsInside(Face face, const Pixel& pixel) const
{
  const Pixel &a = face->vertex(0)->point(), &b = face->vertex(1)->point(),
              &c = face->vertex(2)->point();
  return !this->Delaunay.is_infinite(face) && CGAL::orientation(a, b, pixel) == CGAL::LEFT_TURN &&
    CGAL::orientation(b, c, pixel) == CGAL::LEFT_TURN &&
    CGAL::orientation(c, a, pixel) == CGAL::LEFT_TURN;
}

// Only points over the triangulated region can stick out of it.
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

// Takes the candidates out of the star, but for the one that has been inserted.
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
    ++info.version;
  }
}

// The triangles around a vertex, counter-clockwise, with the infinite ones beyond the hull.
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

// Gives candidates to the triangles around a new vertex. They fill the hole that its insertion
// made, and each spans less than half a turn: the two edges at the vertex decide which of them a
// point is in.
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
    // It hides the point that is already there: the same triangles, but higher.
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
  // All triangles that were in conflict with the point are now, in another shape, around it, and
  // still hold their lists; on the hull, one may have become infinite.
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
  while (!this->Queue.empty())
  {
    ThrowIfCancelled(stop);
    const Highest highest = this->Queue.top();
    this->Queue.pop();
    if (highest.version == highest.face->info().version)
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
  }
  for (const Face face : this->Delaunay.finite_face_handles())
  {
    map.triangles.push_back({ face->vertex(0)->info().point, face->vertex(1)->info().point,
      face->vertex(2)->info().point });
  }
}

}

void DelaunayDisparityOptions::Check() const
{
  if (!(this->tolerance >= 0))
  {
    throw Error("The tolerance of the minimum disparity constraint must not be negative.");
  }
}

namespace
{

// The view's edges, between its features that could be sighted.
std::vector<std::array<int, 2>> SightedEdges(const View& view, const std::vector<int>& sighted)
{
  std::vector<std::array<int, 2>> edges;
  for (const auto& [a, b] : view.edges)
  {
    if (sighted[a] >= 0 && sighted[b] >= 0)
    {
      edges.push_back({ sighted[a], sighted[b] });
    }
  }
  return edges;
}

// What a view sees of the other views' features.
std::vector<SightedFeature> FeaturesOfOthers(
  const Camera& camera, int index, const FeatureCloud& cloud, const CancellationFlag& stop)
{
  std::vector<SightedFeature> others;
  others.reserve(cloud.Size());
  SightedFeature sighting;
  cloud.VisitSeen(camera,
    [&](const FeatureCloud::Feature& feature)
    {
      ThrowIfCancelled(stop);
      if (feature.sourceView != index && Sight(camera, feature.point, sighting))
      {
        sighting.feature = &feature;
        others.push_back(sighting);
      }
    });
  return others;
}

template <typename Triangulation>
DisparityMap TriangulateWith(const View& view, int index, const FeatureCloud& cloud,
  const DelaunayDisparityOptions& options, const CancellationFlag& stop)
{
  std::vector<SightedPoint> own;
  std::vector<int> sighted(view.points.size(), -1);
  SightedPoint sighting;
  sighting.sourceView = index;
  own.reserve(view.points.size());
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    if (Sight(view.camera, view.points[i], sighting))
    {
      sighted[i] = static_cast<int>(own.size());
      sighting.point = view.points[i];
      own.push_back(sighting);
    }
  }
  DisparitySurface<Triangulation> surface(view);
  surface.TriangulateFeatures(own, stop);
  surface.KeepEdges(SightedEdges(view, sighted));
  if (options.minimumDisparity)
  {
    surface.AddCandidates(FeaturesOfOthers(view.camera, index, cloud, stop), stop);
    surface.EnforceMinimumDisparity(options.tolerance, stop);
  }
  DisparityMap map;
  map.name = view.name;
  map.imageFile = view.imageFile;
  map.camera = view.camera;
  surface.Fill(map);
  return map;
}

DisparityMap TriangulateOne(const View& view, int index, const FeatureCloud& cloud,
  const DelaunayDisparityOptions& options, const CancellationFlag& stop)
{
  return options.keepEdges && !view.edges.empty()
    ? TriangulateWith<ConstrainedTriangulation>(view, index, cloud, options, stop)
    : TriangulateWith<PlainTriangulation>(view, index, cloud, options, stop);
}

}

DisparityMap TriangulateView(
  const std::vector<View>& views, std::size_t index, const DelaunayDisparityOptions& options)
{
  options.Check();
  return TriangulateOne(
    views[index], static_cast<int>(index), FeatureCloud(views), options, NeverCancelled);
}

std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const FeatureCloud& cloud, const DelaunayDisparityOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  std::vector<double> work;
  std::transform(views.begin(), views.end(), std::back_inserter(work),
    [](const View& view) { return static_cast<double>(view.points.size()); });
  std::vector<DisparityMap> maps(views.size());
  ParallelForWithProgress(work, parallelFor, progress,
    [&](std::size_t v, const CancellationFlag& stop)
    { maps[v] = TriangulateOne(views[v], static_cast<int>(v), cloud, options, stop); });
  return maps;
}

std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const DelaunayDisparityOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  const FeatureCloud cloud(options.minimumDisparity ? views : std::vector<View>());
  return TriangulateViews(views, cloud, options, parallelFor, progress);
}

}
