// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProposeClusters_h
#define freespace_ProposeClusters_h

#include "Scene/Scene.h"

#include <array>
#include <string>
#include <vector>

namespace freespace
{

/// What makes images good neighbours for edge stereo. All lengths are judged as angles at the
/// scene, so that nothing here has a unit.
struct ClusterProposalOptions
{
  double preferredAngle = 5.0; ///< between the rays of a neighbour and the reference, degrees
  double minimumAngle = 1.0;   ///< below it depth is too uncertain, degrees; > 0
  double maximumAngle = 20.0;  ///< above it the pictures differ too much, degrees
  double minimumOverlap = 0.4; ///< fraction of the reference's picture that a neighbour sees too
  double leastQuality = 0.5;   ///< of a triplet, as a fraction of the scene's best
  double separation = 5.0;     ///< of two references seen from the scene, degrees: nearer ones have
                               ///< the same free space; 0 makes every possible image a reference

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Two neighbours on opposite sides of the reference.
struct ProposedTriplet
{
  std::array<int, 2> neighbors = { 0, 0 };  ///< indices of images; left or upper, right or lower
  std::array<double, 2> angle = { 0, 0 };   ///< of each to the reference, degrees at the scene
  std::array<double, 2> overlap = { 0, 0 }; ///< fraction of the reference's picture seen by each
  double quality = 0;                       ///< in (0, 1]
};

/// A cross, which has two triplets about perpendicular to each other, or a row, which has one.
struct ProposedCluster
{
  int reference = 0; ///< index of the image
  std::vector<ProposedTriplet> triplets;
  double quality = 0; ///< in (0, 2]: that of the first triplet, and of the second as far as it is
                      ///< perpendicular to the first
};

/// Chooses, for each image, the neighbours that make the best cross or else the best row, by
/// baseline, overlap and viewing angle, and of these clusters those that are worth their time: the
/// best first, without those whose reference stands nearer than the separation to one that was
/// chosen. The clusters come in the order of their references.
///
/// How far away the scene is, and what two images have in common, is known from the points of the
/// model. An image without points is taken to look at where its neighbours' optical axes pass it.
/// The time is that of n log n for n images with a bounded number of observations each.
std::vector<ProposedCluster> ProposeClusters(
  const SparseModel& model, const ClusterProposalOptions& options);

/// As a scene.json has them; each is named after its reference.
std::vector<Cluster> ClustersFromProposal(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal);

/// A table for people: a line for each triplet with its images, angles and overlaps.
std::string DescribeProposal(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal);

/// The model with only those images whose photograph is there: SfM models often come without some.
/// Where there is no folder of images at all, the whole model.
SparseModel WithExistingPhotographs(const Scene& scene, SparseModel model);

/// A scene.json, with proposed clusters where it has none of its own. Throws Error as ReadScene and
/// ReadSceneModel do, and when no image can be a reference.
Scene ReadSceneWithClusters(
  const std::string& file, const ClusterProposalOptions& options = ClusterProposalOptions());

}

#endif
