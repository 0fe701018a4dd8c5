// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MaskedEdges_h
#define freespace_MaskedEdges_h

#include "Edges/EdgeTokens.h"

#include <opencv2/core.hpp>

namespace freespace
{

/// The edges without the tokens for which `dropped` is not zero: chains are cut there, and remaining pieces
/// shorter than the minimum length are removed.
EdgeChains EdgesWithout(
  const EdgeChains& edges, const std::vector<char>& dropped, int minimumLength);

/// The edges outside of the black parts of a mask. Chains end at its boundary; the rest of a chain is
/// kept if it has the minimum number of tokens. The edges were found in the whole image: the
/// boundary of a mask makes none. A token on the boundary keeps the colours of both sides, so that a
/// silhouette stays an edge.
EdgeChains EdgesOutside(const EdgeChains& edges, const cv::Mat& mask, int minimumLength);

}

#endif
