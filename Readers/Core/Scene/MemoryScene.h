// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MemoryScene_h
#define freespace_MemoryScene_h

#include "Scene/Scene.h"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace freespace
{

/// An image that is in memory, without the lens's distortion.
struct MemoryImage
{
  std::string name;
  cv::Mat pixels; ///< blue, green, red, 8 bits
  Camera camera;  ///< of the size of the pixels
};

/// A scene of images in memory, and its camera model. The cameras are kept to the last bit. Images of the same
/// intrinsics and size share a lens, as far as the poses are refined. Without clusters they are to be proposed.
///
/// Throws Error naming the image or cluster: no images, two of one name, another size than the camera's, a camera
/// that is not a pinhole with a rotation, an unknown image, a triplet with an image twice, two clusters of one name.
struct MemoryScene
{
  MemoryScene(const std::vector<MemoryImage>& images, std::vector<Cluster> clusters);

  Scene scene;
  SparseModel model;
};

}

#endif
