// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViolatedTriangles_h
#define freespace_ViolatedTriangles_h

#include "Common/DisparityMap.h"
#include "Disparity/FeatureCloud.h"
#include "ViewFreespace/ViewFreespace.h"

namespace freespace
{

/// For each triangle of a view's map whether its free space is wrong: at least `leastFeatures` features of
/// other views lie well in front of it, where it says that there is nothing, and more than lie on it. Features whose
/// distance to the triangle is at most the fraction `relativeRoom` of their depth lie on it. The cloud has the features of all views;
/// those of the view itself (by its index) do not count.
///
/// A single feature that sticks out is what the minimum disparity constraint is for (section 2.1): the
/// view missed an edge. Many are a sign that a corner of the triangle is wrong.
std::vector<char> ViolatedTriangles(const DisparityMap& map, const ViewFreespace& freespace,
  const FeatureCloud& cloud, int viewIndex, int leastFeatures, double relativeRoom);

/// For each point of a map whether it drags the map into matter: it is the deepest corner of violated
/// triangles, and they are more than half of the triangles around it.
std::vector<char> PointsBehindViolations(
  const DisparityMap& map, const std::vector<char>& isViolated);

}

#endif
