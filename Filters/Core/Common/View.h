// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_View_h
#define freespace_View_h

#include "Common/Camera.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace freespace
{

/// The features that one cluster of images recovered, in the frame of its reference camera.
struct View
{
  std::string name;      ///< of the cluster
  std::string imageFile; ///< the reference image, relative to the scene's `images`
  Camera camera;
  std::vector<Eigen::Vector3d> points;      ///< features, world coordinates
  std::vector<Eigen::Vector2d> imagePoints; ///< their positions in the reference image, pixels
  std::vector<std::array<int, 2>> edges;    ///< pairs of features that an image edge joins
  std::vector<double>
    deviations; ///< standard deviations of the features' disparities (1 / depth), 0
                ///< where not known; empty: nowhere
};

/// Attributes of the features of a view from edge stereo.
struct EdgeView : View
{
  std::vector<std::array<std::uint8_t, 3>> colors; ///< red, green, blue in the reference image
  std::vector<Eigen::Vector3d> edgeDirections;     ///< of the edge in the world, unit length
  std::vector<double> matchingCosts;               ///< 0 (perfect) to 1
  std::vector<int> chainIds;                       ///< index into chains
  std::vector<std::vector<int>> chains; ///< features that follow each other along an edge
  std::size_t tokens = 0; ///< edge tokens of the reference image, of which these have a depth
};

}

#endif
