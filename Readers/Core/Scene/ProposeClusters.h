// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProposeClusters_h
#define freespace_ProposeClusters_h

#include "Scene/ClusterProposalOptions.h"
#include "Scene/Scene.h"

#include <array>
#include <string>
#include <vector>

namespace freespace
{

/// The reference between two neighbours; at the end of a row, beside them.
struct ProposedTriplet
{
  std::array<int, 2> neighbors = { 0, 0 };  ///< indices of images; left or upper, right or lower
  std::array<double, 2> angle = { 0, 0 };   ///< of each to the reference, degrees at the scene
  std::array<double, 2> overlap = { 0, 0 }; ///< fraction of the reference's image seen by each
  double quality = 0;                       ///< in (0, 1]
};

/// A cross has two triplets about perpendicular to each other; a row has one, or two of different
/// lengths.
struct ProposedCluster
{
  int reference = 0; ///< index of the image
  std::vector<ProposedTriplet> triplets;
  double quality =
    0; ///< in (0, 2]: that of the first triplet, and of the second as far as it tells
       ///< something new
  bool cross = false;
};

/// The clusters of a model, and the images that have none.
struct ClusterProposal
{
  std::vector<ProposedCluster> clusters; ///< in the order of their references
  std::vector<int> spare;                ///< images whose sight others cover
  std::vector<int> alone;                ///< images without two suitable neighbours

  bool Empty() const { return this->clusters.empty(); }
};

/// Chooses, for each image, the neighbours that make the best cross or else the best row, by
/// baseline, overlap and viewing angle, each image compared with its own surroundings only; then selects
/// the clusters to keep, see ChooseReferences.
///
/// The distance of the scene and the overlap of images come from ImageNeighborhoods. The time is
/// O(n log n) for n images with a bounded number of observations each.
ClusterProposal ProposeClusters(const SparseModel& model, const ClusterProposalOptions& options);

/// As a scene.json has them; each is named after its reference.
std::vector<Cluster> ClustersFromProposal(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal);

/// A readable table: a line for each triplet with its images, angles and overlaps.
std::string DescribeClusters(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal);

/// In one line without an end: "20 of 23 images are references; 1 sees what others see; 2 have no
/// partner: a.jpg, b.jpg". Of many names the first few.
std::string DescribeChoice(const SparseModel& model, const ClusterProposal& proposal);

}

#endif
