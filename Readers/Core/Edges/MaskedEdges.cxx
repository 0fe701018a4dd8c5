// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/MaskedEdges.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

bool IsIgnored(const Eigen::Vector2d& position, const cv::Mat& mask)
{
  const int column = std::clamp(static_cast<int>(std::floor(position.x())), 0, mask.cols - 1);
  const int row = std::clamp(static_cast<int>(std::floor(position.y())), 0, mask.rows - 1);
  return mask.at<unsigned char>(row, column) == 0;
}

}

EdgeChains EdgesOutside(const EdgeChains& edges, const cv::Mat& mask, int minimumLength)
{
  if (mask.empty())
  {
    return edges;
  }
  EdgeChains outside;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    int first = edges.begin[chain];
    for (int i = first; i <= edges.begin[chain + 1]; ++i)
    {
      if (i < edges.begin[chain + 1] && !IsIgnored(edges.tokens[i].position, mask))
      {
        continue;
      }
      if (i - first >= minimumLength)
      {
        outside.tokens.insert(
          outside.tokens.end(), edges.tokens.begin() + first, edges.tokens.begin() + i);
        outside.begin.push_back(static_cast<int>(outside.tokens.size()));
      }
      first = i + 1;
    }
  }
  return outside;
}

}
