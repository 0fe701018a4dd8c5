// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewSelection_h
#define freespace_ViewSelection_h

#include "Texture/Photograph.h"
#include "Mesh/TriangleMesh.h"
#include "Texture/VisibilityMap.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// The views that have most of the weight at the samples of the surface when it is seen from a novel
/// centre of projection, at most `count`, in ascending order. A view weighs more the less its direction
/// differs from the novel one. There is one visibility map per view.
std::vector<int> BestViews(const std::vector<Photograph>& views,
  const std::vector<VisibilityMap>& maps, const std::vector<Eigen::Vector3d>& samples,
  const Eigen::Vector3d& novelCenter, std::size_t count);

/// Views by rising chord: a lower bound of the difference between the directions to the view and to the
/// novel centre, as the chord between unit vectors, over the samples of the surface.
struct ViewOrder
{
  std::vector<int> views;    ///< indices into the centres
  std::vector<float> chords; ///< of these views
};

/// The shader visits the views in this order and stops where none can be among the best any more.
ViewOrder OrderViews(const std::vector<Eigen::Vector3d>& centers,
  const std::vector<Eigen::Vector3d>& samples, const Eigen::Vector3d& novelCenter);

}

#endif
