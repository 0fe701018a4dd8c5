// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SceneClusters_h
#define freespace_SceneClusters_h

#include "Scene/ProposeClusters.h"

#include <string>

namespace freespace
{

/// The model with only those images whose files exist: models often come without some.
/// Where there is no folder of images at all, the whole model. Throws Error when the folder has none of
/// them.
SparseModel WithExistingPhotographs(const Scene& scene, SparseModel model);

/// The scene with clusters proposed from its model, of those images whose files exist. Throws Error
/// when no image can be a reference.
Scene WithProposedClusters(Scene scene, const SparseModel& model,
  const ClusterProposalOptions& options, std::string* choice = nullptr);

/// A scene.json, with proposed clusters where it has none of its own; what DescribeChoice says about
/// these is put into `choice` when that is given. Throws Error as ReadScene and ReadSceneModel do, and
/// when no image can be a reference.
Scene ReadSceneWithClusters(const std::string& file,
  const ClusterProposalOptions& options = ClusterProposalOptions(), std::string* choice = nullptr);

}

#endif
