// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ChanceMatches_h
#define freespace_ChanceMatches_h

#include "Agreement/ImageAgreement.h"
#include "Images/CalibratedImage.h"
#include "Scene/Scene.h"

#include <functional>
#include <vector>

namespace freespace
{

/// Matches a cluster given the cameras of all images.
using ClusterMeasure =
  std::function<ImageAgreement(const std::vector<CalibratedImage>& images, const Cluster& cluster)>;

/// Whether an image has more confirmed tokens than chance gives. Chance is measured: with a camera that was turned to
/// where the image cannot have been taken (rolled by 180 degrees, turned aside, turned up); the greatest of the three counts.
///
/// agreement: of the image in the cluster of which it is the reference, with the given cameras.
bool ExceedsChance(const std::vector<CalibratedImage>& images, const Cluster& cluster,
  const ImageAgreement& agreement, const ClusterMeasure& measure);

/// Those of some images that at least two others of them, which are its neighbours, confirm as a group.
///
/// agreements: of the images, in the cluster of which each is the reference.
std::vector<int> ConfirmedByEachOther(const std::vector<ImageAgreement>& agreements);

}

#endif
