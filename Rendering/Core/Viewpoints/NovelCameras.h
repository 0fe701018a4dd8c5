// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NovelCameras_h
#define freespace_NovelCameras_h

#include "Common/View.h"

#include <vector>

namespace freespace
{

/// Viewpoints that no camera has but from which what the images show is seen well. Each looks the way
/// of a view, turned by at most 15 degrees towards the next one that looks another way (by 10 to 120
/// degrees; aside where there is none), upright (CommonUp.h), and from where the features of all views that look
/// about the same way fill its picture (FramePoints.h): from near the cameras, not from behind, and
/// without the rims that no camera saw. The first is beside the view that sees most, each further one looks
/// as different a way as may be from those before.
///
/// At most `count` cameras are returned, fewer where fewer ways were looked, none without features. Intrinsics and
/// size are those of the first view's camera.
std::vector<Camera> NovelCameras(const std::vector<View>& views, int count);

/// The middle of points, by the median of each coordinate, which a few that are far off do not move.
/// Zero without points.
Eigen::Vector3d MedianPoint(const std::vector<Eigen::Vector3d>& points);

}

#endif
