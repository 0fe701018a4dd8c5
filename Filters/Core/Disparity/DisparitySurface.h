// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparitySurface_h
#define freespace_DisparitySurface_h

#include "Common/CancellationFlag.h"
#include "Common/DisparityMap.h"
#include "Common/View.h"
#include "Disparity/FeatureCloud.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <array>
#include <cstdint>
#include <queue>
#include <string>
#include <unordered_set>
#include <vector>

namespace freespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Pixel = Kernel::Point_2;

/// Data of a triangle: the head of the list of the candidates inside it, when it last changed, by which outdated entries
/// of the queue are recognized, and when its edges were last looked at to flip them. Times are numbers of changes of all
/// triangles.
struct FaceInfo
{
  int firstCandidate = -1;
  unsigned int changed = 0;
  unsigned int lookedAt = 0;
};

/// Data of a vertex: the index of its point, and the point's disparity, which is read often.
struct VertexInfo
{
  int point = 0;
  double disparity = 0;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>;
using PlainTriangulation = CGAL::Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
/// With constrained edges. Constraints that intersect others would need new points: they are left
/// out.
using ConstrainedTriangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<VertexBase,
    CGAL::Constrained_triangulation_face_base_2<Kernel, FaceBase>>,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// The projection of a point into a view.
struct Sighting
{
  Pixel pixel = Pixel(0, 0);
  double disparity = 0;
};

/// A world point with its projection into a view.
struct SightedPoint : Sighting
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int sourceView = 0;
  double deviation = 0; ///< standard deviation of an own feature's disparity; 0: not known
};

/// A feature of another view with its projection. Small, as there are many and few are inserted.
struct SightedFeature : Sighting
{
  const FeatureCloud::Feature* feature = nullptr;
};

/// The triangulated disparity surface of one view while points are inserted into it.
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

  /// The Delaunay triangulation of the view's own features. Throws Error, naming the view, when
  /// there are fewer than three or all are collinear; Aborted when `stop` is set.
  void TriangulateFeatures(const std::vector<SightedPoint>& features, const CancellationFlag& stop);
  /// Constrains edges, given as pairs of features, where the triangulation is a constrained one.
  void KeepEdges(const std::vector<std::array<int, 2>>& edges);
  /// Sorts other views' features into the triangles. Only those inside the convex hull can violate
  /// the minimum disparity constraint.
  void AddCandidates(std::vector<SightedFeature> sightings, const CancellationFlag& stop);
  /// Inserts the candidate that is highest above the surface until none is above it by more than
  /// the tolerance, a fraction of the candidate's disparity.
  void EnforceMinimumDisparity(double tolerance, const CancellationFlag& stop);
  /// Flips edges whose two triangles are badly shaped in space, see
  /// DelaunayDisparityOptions::leastCotangents, but not the given pairs of features, and enforces the
  /// constraint anew with the same tolerance.
  void FlipEdges(double leastCotangents, const std::vector<std::array<int, 2>>& kept,
    const CancellationFlag& stop);
  /// Writes the points and triangles into a map.
  void Fill(DisparityMap& map) const;

private:
  // A point that may violate the constraint, linked into the list of its triangle. It holds only
  // what the inner loops read, and candidates are stored along a space-filling curve, for the
  // cache.
  struct Candidate
  {
    Pixel pixel;
    double disparity;
    double height; // above the surface, disparity
    int next;      // in the same triangle
    int given;     // index of the sighting
  };

  // The candidate of a triangle that is highest above it.
  struct Highest
  {
    double height;
    int candidate;
    int given;
    Face face;
    unsigned int changed; // of the face, when this was pushed

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
  void InsertHighest(const CancellationFlag& stop);
  void TakeCandidates(int inserted);
  void FindStar(Vertex center);
  void Redistribute(Vertex center);
  static bool IsSettled(Face face, Face neighbor);
  static double RiseOfFlip(Vertex apex, Vertex a, Vertex other, Vertex b);
  bool WantsFlip(Face face, int index, double leastCotangents) const;
  void Flip(Face face, int index);
  int FlipOnce(double leastCotangents, const CancellationFlag& stop);

  std::string Name;
  std::vector<SightedPoint> Points;  // of the triangulation, indexed by VertexInfo::point
  std::vector<Vertex> OfFeature;     // the vertex of each feature, or the one that hides it
  std::vector<SightedFeature> Given; // features of the other views
  std::vector<Candidate> Candidates;
  Triangulation Delaunay;
  std::priority_queue<Highest> Queue;
  double Tolerance = 0;
  unsigned int Changes = 0;               // of triangles
  std::vector<Face> Star;                 // around the point that is being inserted
  std::vector<int> Homeless;              // the candidates of the triangles that it replaced
  std::unordered_set<std::uint64_t> Kept; // edges that are not flipped, as pairs of points
};

extern template class DisparitySurface<PlainTriangulation>;
extern template class DisparitySurface<ConstrainedTriangulation>;

}

#endif
