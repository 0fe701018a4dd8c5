// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DepthMapBytes_h
#define freespace_DepthMapBytes_h

#include <algorithm>
#include <string>
#include <vector>

namespace freespace
{

/// COLMAP's dense map: a header of text, then little-endian floats row by row.
inline std::string ColmapDepthBytes(int width, int height, const std::vector<float>& depths)
{
  std::string bytes = std::to_string(width) + "&" + std::to_string(height) + "&1&";
  bytes.append(reinterpret_cast<const char*>(depths.data()), depths.size() * sizeof(float));
  return bytes;
}

/// A portable float map: the bottom row first, a positive scale for big-endian numbers.
inline std::string PfmBytes(
  int width, int height, const std::vector<float>& depths, bool isBigEndian)
{
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
    (isBigEndian ? "1.0" : "-1.0") + "\n";
  for (int row = height - 1; row >= 0; --row)
  {
    for (int column = 0; column < width; ++column)
    {
      std::string number(
        reinterpret_cast<const char*>(&depths[row * width + column]), sizeof(float));
      if (isBigEndian)
      {
        std::reverse(number.begin(), number.end());
      }
      bytes += number;
    }
  }
  return bytes;
}

}

#endif
