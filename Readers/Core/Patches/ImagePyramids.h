// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImagePyramids_h
#define freespace_ImagePyramids_h

#include "Images/ImageCache.h"
#include "Scene/Scene.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace freespace
{

/// An image without the lens's distortion, ready to be compared with others.
struct ImagePyramid
{
  cv::Mat3b color; ///< blue, green, red
  cv::Mat1b mask;  ///< 0 where the image is to be ignored; empty without a mask
  /// Grey levels, slightly smoothed; each level has half the resolution of the one before it.
  std::vector<cv::Mat1f> levels;
};

/// The images of a scene. An image belongs to several clusters: the most recently used ones are kept, as far
/// as memory allows. Thread-safe.
class ImagePyramids
{
public:
  /// Keeps up to `mostPixels` pixels (of 8 bytes) of the most recently used images.
  explicit ImagePyramids(const Scene& scene, std::size_t mostPixels = std::size_t(1) << 26);

  /// Throws Error naming the file: missing, unreadable or of another size than the camera's.
  std::shared_ptr<const ImagePyramid> Find(const CalibratedImage& image);

private:
  ImagePyramid Read(const CalibratedImage& image) const;

  Scene Source; // for its folders
  ImageCache<ImagePyramid> Cache;
};

}

#endif
