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

EdgeChains EdgesWithout(
  const EdgeChains& edges, const std::vector<char>& dropped, int minimumLength)
{
  EdgeChains kept;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    int first = edges.begin[chain];
    for (int i = first; i <= edges.begin[chain + 1]; ++i)
    {
      if (i < edges.begin[chain + 1] && !dropped[static_cast<std::size_t>(i)])
      {
        continue;
      }
      if (i - first >= minimumLength)
      {
        kept.tokens.insert(
          kept.tokens.end(), edges.tokens.begin() + first, edges.tokens.begin() + i);
        kept.begin.push_back(static_cast<int>(kept.tokens.size()));
      }
      first = i + 1;
    }
  }
  return kept;
}

EdgeChains EdgesOutside(const EdgeChains& edges, const cv::Mat& mask, int minimumLength)
{
  if (mask.empty())
  {
    return edges;
  }
  std::vector<char> ignored;
  ignored.reserve(edges.tokens.size());
  for (const EdgeToken& token : edges.tokens)
  {
    ignored.push_back(IsIgnored(token.position, mask));
  }
  return EdgesWithout(edges, ignored, minimumLength);
}

}
