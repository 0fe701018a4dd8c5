// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FreespaceUnion_h
#define freespace_FreespaceUnion_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourField.h"
#include "Freespace/MapFreespace.h"
#include "Freespace/ViewOctree.h"
#include "Freespace/Votes/ViewVotes.h"
#include "ViewFreespace/ViewFreespace.h"

#include <memory>
#include <mutex>

namespace freespace
{

/// How the free spaces of the views are united.
struct FreespaceUnionOptions
{
  static constexpr double AutomaticMargin = -1;
  static constexpr int AutomaticViews = -1;

  /// Number of views in whose free space a point must lie to be free; >= 1, at most the number of
  /// views; 1 in the paper. AutomaticViews: three, or fewer where no more views contradict them: those
  /// that have the point closely behind their own surface. So one view's error does not carve what others saw, and a
  /// place that one view alone sees is free.
  int minimumViews = AutomaticViews;

  /// How far behind its surface a view contradicts others, with AutomaticViews: the length that the distance of its
  /// features, in the image, has there, times this; > 0. Farther behind it, the place may be hidden from the view,
  /// which has no vote.
  double contradiction = 1.0;

  /// Offset of the hull's planes to the outside, as a fraction of the diagonal of the region's box;
  /// >= 0, < 10; 0 in the paper. AutomaticMargin: hullMarginCells applies.
  double hullMargin = AutomaticMargin;

  /// The same in cells of the suggested lattice, or in distances of the features on the surface where these are
  /// greater; >= 0. Matter on the hull, such as a floor, must be thick enough for the lattice; and where features
  /// are sparse, the surface extends beyond the outermost ones.
  double hullMarginCells = 1.25;

  /// Number of distances of the features along the longest side that the margin takes them to have at least; >= 1.
  int hullMarginFewest = 64;

  RegionOptions region;         ///< the hull is that of the features in this region
  ResolutionOptions resolution; ///< of the suggested lattice

  /// The ball around each camera inside the hull that is free, as a fraction of the distance to the
  /// nearest features; in [0, 1); 0: none.
  double surroundings = 0.5;

  /// The margin of the hull, as a fraction of the diagonal, for these numbers of lattice cells and of distances of the
  /// features along the longest side.
  double MarginFor(double cells, double distances) const;

  /// The hullMargin to set for a lattice of a chosen number of cells; 0 or less: as many as suggested. A coarser one
  /// than is ever suggested needs a greater margin than the automatic one.
  static double MarginOfLattice(int cells);

  /// Throws Error when a field is out of its range.
  void Check() const;
  /// The same, and when it does not fit the number of views, or these are too many.
  void CheckFor(std::size_t views) const;
};

/// Phi' of section 2.2: the union of the views' free spaces and of the outside of the convex hull
/// of the features in the region of interest. Features beyond it carve like all others. What a map without any feature
/// has free, a silhouette, is free whatever the other views say.
///
/// The value at a point is negative in matter, positive in free space, zero on the boundary. It is
/// the greater of two lengths: the signed distance to the hull, and, over the views that claim the
/// point, the depth of the map less the depth of the point (with minimumViews = k the k-th
/// greatest; with AutomaticViews the j-th greatest counts, too, as far as at most j views contradict). It is
/// continuous except at the silhouette walls, where a view's claim ends.
class FreespaceUnion : public ContourField
{
public:
  /// Throws Error when an option is out of range, minimumViews included, or the index of a
  /// triangle's point is; Aborted when the progress asks to stop.
  FreespaceUnion(const std::vector<DisparityMap>& maps, const FreespaceUnionOptions& options,
    const ParallelFor& parallelFor = SerialFor, const Progress& progress = {});

  /// The same for maps that need not all be in memory.
  FreespaceUnion(std::size_t count, const MapSource& mapOf, const FreespaceUnionOptions& options,
    const ParallelFor& parallelFor = SerialFor, const Progress& progress = {});

  /// The same for maps whose own structures are there, such as some of another union's: only what depends on all of
  /// them is made, the region, the hull and the surroundings of the cameras.
  FreespaceUnion(const SharedMaps& maps, const FreespaceUnionOptions& options,
    const ParallelFor& parallelFor, const Progress& progress);

  /// Builds the octree of the views, which otherwise the first call of IsFree (if there are many
  /// views) or of ScopeAround builds. Throws Aborted when the progress asks to stop.
  void IndexForPoints(const Progress& progress) const;
  void IndexForBoxes(const Progress& progress) const;

  /// Infinite if there are no features at all: everything is free.
  double Value(const Eigen::Vector3d& point) const;

  /// The gradient of Value.
  Eigen::Vector3d Gradient(const Eigen::Vector3d& point) const;

  /// The sign of Value, faster. Zero is matter; points that are not finite are free.
  bool IsFree(const Eigen::Vector3d& point) const;

  /// Whether enough views have the point in their free space, regardless of the hull.
  bool IsSeenFree(const Eigen::Vector3d& point) const;

  bool IsFree(const Eigen::Vector3d& point, const FieldScope& scope) const override;
  FieldScope Root() const override;

  /// The scope of a box: the views that are undecided in it, fewer than at the root.
  FieldScope ScopeAround(const Eigen::AlignedBox3d& box) const;

  BoxContent Classify(
    const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const override;

  /// Decides the views of a scope by their triangles, for a small box that Classify left Mixed.
  BoxContent ClassifyFinely(const Eigen::AlignedBox3d& box, FieldScope& scope) const;

  bool Crossing(const Eigen::Vector3d& matter, const Eigen::Vector3d& free, const FieldScope& scope,
    double& place, SurfaceLabel& label) const override;
  SurfaceLabel Label(const Eigen::Vector3d& free, const Eigen::Vector3d& matter,
    const FieldScope& scope) const override;
  bool IsThreadSafe() const override { return true; }

  /// When the votes of the views make a place free.
  const VoteRule& Rule() const { return this->Votes; }
  /// The margin of VoteOn for a view of a scope: the surroundings of cameras contradict nothing.
  double MarginOf(int view) const { return this->Margins[static_cast<std::size_t>(view)]; }
  const FeatureHull& Hull() const { return *this->Region.hull; }
  const RegionOfInterest& FeatureRegion() const { return this->Region.region; }
  /// The lattice that the features in the region ask for, along its longest side.
  int Cells() const { return this->Region.cells; }
  double CellSide() const
  {
    return this->Region.cellSide;
  } ///< that they ask for, whatever the bounds of Cells
  const std::vector<Eigen::Vector3d>& Features() const
  {
    return this->Region.features;
  } ///< in the region
  std::size_t NumberOfViews() const { return this->Maps.size(); }
  const SharedMaps& GetMaps() const { return this->Maps; }
  const ViewFreespace& ViewAt(std::size_t i) const { return *this->Views[i]; }
  /// The map that labels name for a view of a scope: the view itself, or that of a camera with surroundings.
  int MapOf(int view) const
  {
    const int added = view - static_cast<int>(this->Maps.size());
    return added < 0 ? view : this->AddedView[static_cast<std::size_t>(added)];
  }
  /// Whether views of two unions are one, or equal surroundings of a camera.
  bool HasSameView(int view, const FreespaceUnion& other, int otherView) const;

private:
  struct Winner
  {
    double value;
    Eigen::Vector3d gradient;
  };
  template <typename Question>
  BoxContent VoteOnBox(
    const std::vector<int>& views, FieldScope& scope, const Question& question) const;
  SurfaceLabel LabelOfView(
    int view, const Eigen::Vector3d& crossing, const Eigen::Vector3d& towardsFree) const;
  Winner Evaluate(const Eigen::Vector3d& point) const;

  bool IsVotedFree(
    const Eigen::Vector3d& point, VoteCount votes, const int* begin, const int* end) const;
  void FirstFree(const Eigen::Vector3d& matter, const Eigen::Vector3d& free,
    const FieldScope& scope, double& place, SurfaceLabel& label) const;
  void FirstVotedFree(const Eigen::Vector3d& matter, const Eigen::Vector3d& free,
    const FieldScope& scope, double& place, SurfaceLabel& label) const;
  SurfaceLabel LabelOfContradiction(
    const Eigen::Vector3d& free, const Eigen::Vector3d& matter, const FieldScope& scope) const;
  Winner Voted(std::vector<Winner> claims, std::vector<Winner> unopposed) const;
  void FindMargins(const std::vector<ViewFeatures>& features);
  void AddSilhouettes(const std::vector<ViewFeatures>& features);
  void AddSurroundings(const std::vector<ViewFeatures>& features);
  SurfaceLabel OfMaps(SurfaceLabel label) const;
  const ViewOctree& FreeIndex(const Progress& progress = {}) const;
  const ViewOctree& ClaimIndex() const;

  FreespaceUnionOptions Options;
  VoteRule Votes;
  SharedMaps Maps;
  /// Of the maps, then those that count more than once: silhouettes and the surroundings of cameras.
  std::vector<std::shared_ptr<const ViewFreespace>> Views;
  std::vector<int> AllViews;   ///< their indices
  std::vector<double> Margins; ///< of VoteOn, per view
  std::vector<int> AddedView;  ///< of those after the maps': the index of their view
  std::vector<std::vector<Eigen::Vector3d>> AddedCorners; ///< of these; empty for silhouettes
  RegionHull Region;
  mutable std::once_flag FreeIsIndexed, ClaimsAreIndexed; ///< both are built when first needed
  mutable std::unique_ptr<ViewOctree> Free, Claims;
};

}

#endif
