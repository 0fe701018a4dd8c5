// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraDrawing_h
#define freespace_CameraDrawing_h

#include "Common/Camera.h"

#include <string>
#include <vector>

namespace freespace
{

/// The cameras of a cluster, drawn in one colour.
struct CameraGroup
{
  std::string name;
  std::vector<Camera> cameras; ///< the first is the reference
};

/// Figure 9 of the paper as an SVG element: each camera a pyramid that opens towards what it looks at, each
/// group in its colour and labelled, the reference filled, over the points of the scene, seen obliquely
/// from above by a parallel projection. Of the points at most 6,000 are drawn. The names are escaped; colours come
/// from the page's style by the classes camera, reference, point and label and the variable --group.
std::string DrawCameras(
  const std::vector<CameraGroup>& groups, const std::vector<Eigen::Vector3d>& points);

/// The colour of a group as CSS has it: equal steps of hue.
std::string GroupColor(std::size_t group, std::size_t count);

}

#endif
