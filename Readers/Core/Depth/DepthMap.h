// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DepthMap_h
#define freespace_DepthMap_h

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// The depths of an image's pixels, the top row first. Values that are not positive and finite are unknown.
struct DepthMap
{
  int width = 0;
  int height = 0;
  std::vector<float> depths;

  float At(int column, int row) const
  {
    return this->depths[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->width) +
      static_cast<std::size_t>(column)];
  }
};

/// Reads a depth map by the file's extension: COLMAP's dense .bin, a .pfm of one channel, or a .png of 16 bits
/// and one channel. Throws Error naming the file and the fault.
DepthMap ReadDepthMap(const std::string& file);

/// The name of the image of a depth map by the file's name: a.jpg of a.jpg.geometric.bin and a.jpg.pfm, a of
/// a.png. The image's own ending may be missing.
std::string ImageNameOfDepthMap(const std::string& file);

}

#endif
