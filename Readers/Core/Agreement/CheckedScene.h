// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CheckedScene_h
#define freespace_CheckedScene_h

#include "Agreement/WrongImages.h"
#include "Scene/ClusterProposalOptions.h"

#include <string>
#include <vector>

namespace freespace
{

/// A scene without the images that do not fit the others.
struct CheckedScene
{
  Scene given;          ///< with the clusters that its file names, if any, of consistent images
  Scene scene;          ///< the same, or with proposed clusters
  SparseModel model;    ///< of the right images
  std::string choice;   ///< what DescribeChoice says about proposed clusters
  ClusterTracks tracks; ///< what FindWrongImages matched; none where it found some
  std::vector<std::string> warnings; ///< a sentence each, which names the images that are left out
};

/// Looks for wrong images if requested (`check`): those whose observations are not the projections
/// of their points (FindMisprojectedImages), and those whose edges contradict the others'
/// (FindWrongImages). Proposes clusters of the remaining images where the scene names none; wrong images
/// are removed from those that it names (WithoutImages).
///
/// `model` is the scene's (ReadSceneModel, MemoryScene). Throws Error when no cluster is left or can be proposed, and
/// what the steps throw.
CheckedScene CheckScene(const Scene& scene, SparseModel model, EdgeStore& edges,
  const MatcherOptions& matching, const ClusterProposalOptions& clusters, bool check,
  const ParallelFor& parallelFor, const Progress& progress);

}

#endif
