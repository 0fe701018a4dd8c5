// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Photograph_h
#define freespace_Photograph_h

#include "Common/Camera.h"

#include <string>
#include <vector>

namespace freespace
{

/// Bytes that a pixel takes while a texture is made: its colour twice, as it is given and copied, and a confidence.
constexpr double MemoryOfPixel = 3 + 3 + sizeof(float);

/// An image without distortion, and the camera that took it.
struct Photograph
{
  std::string name;
  Camera camera;                  ///< its width and height are the image's
  std::vector<unsigned char> rgb; ///< three for each pixel, the top row first
};

/// The image in fewer pixels, so that neither side is longer than `longest`; each is the mean
/// of those it covers. The camera is changed to suit. An image that is small enough is returned
/// as it is.
Photograph Reduced(const Photograph& photograph, int longest);

}

#endif
