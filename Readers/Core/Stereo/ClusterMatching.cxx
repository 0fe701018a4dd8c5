// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/ClusterMatching.h"

#include "Common/Error.h"
#include "Epipolar/DisparityRange.h"

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

int FindImage(
  const std::vector<CalibratedImage>& images, const std::string& file, const Cluster& cluster)
{
  const auto found = std::find_if(
    images.begin(), images.end(), [&](const CalibratedImage& image) { return image.file == file; });
  if (found == images.end())
  {
    throw Error("Cluster '" + cluster.name + "' names the image " + file +
      ", which the camera model does not have.");
  }
  return static_cast<int>(found - images.begin());
}

// The range of disparities that the options allow and that some triplet of the cluster sees.
DisparityRange SearchRange(
  const std::vector<CalibratedImage>& images, const Cluster& cluster, const MatcherOptions& options)
{
  DisparityRange all{ std::numeric_limits<double>::infinity(), 0 };
  for (const auto& triplet : cluster.triplets)
  {
    const auto camera = [&](int k) -> const Camera&
    { return images[FindImage(images, triplet[k], cluster)].camera; };
    const DisparityRange range = CommonRange(
      camera(1), camera(0), camera(2), { options.minimumDisparity, options.maximumDisparity });
    if (range.Empty())
    {
      throw Error("Cluster '" + cluster.name + "': the images " + triplet[0] + ", " + triplet[1] +
        " and " + triplet[2] + " do not overlap within the range of depths.");
    }
    all.minimum = std::min(all.minimum, range.minimum);
    all.maximum = std::max(all.maximum, range.maximum);
  }
  return all;
}

// Every n-th piece of the chains, so that about this many tokens remain, spread over the image.
EdgeChains SomePieces(const EdgeChains& all, std::size_t mostTokens)
{
  constexpr int piece = 24; // tokens: long enough to be matched by themselves
  const std::size_t stride =
    1 + (std::max<std::size_t>(all.tokens.size(), 1) - 1) / std::max<std::size_t>(mostTokens, 1);
  if (stride == 1)
  {
    return all;
  }
  EdgeChains some;
  std::size_t number = 0; // of the piece
  for (std::size_t chain = 0; chain < all.NumberOfChains(); ++chain)
  {
    for (int begin = all.begin[chain]; begin < all.begin[chain + 1]; begin += piece)
    {
      if (number++ % stride == 0)
      {
        const int end = std::min(begin + piece, all.begin[chain + 1]);
        some.tokens.insert(some.tokens.end(), all.tokens.begin() + begin, all.tokens.begin() + end);
        some.begin.push_back(static_cast<int>(some.tokens.size()));
      }
    }
  }
  return some;
}

}

ClusterMatches MatchCluster(EdgeStore& edges, const std::vector<CalibratedImage>& images,
  const Cluster& cluster, const MatcherOptions& options, std::size_t mostTokens,
  const CancellationFlag& stop)
{
  ClusterMatches result;
  result.referenceImage = FindImage(images, cluster.reference, cluster);
  MatcherOptions matching = options;
  const DisparityRange range = SearchRange(images, cluster, matching);
  matching.minimumDisparity = range.minimum;
  matching.maximumDisparity = range.maximum;

  const CalibratedImage& reference = images[result.referenceImage];
  result.reference = { reference.camera, SomePieces(*edges.Edges(reference), mostTokens) };
  for (const std::string& file : OtherImages(cluster))
  {
    ThrowIfCancelled(stop);
    result.otherImages.push_back(FindImage(images, file, cluster));
    const CalibratedImage& other = images[result.otherImages.back()];
    result.others.push_back({ other.camera, *edges.Edges(other) });
  }
  ThrowIfCancelled(stop);
  result.matches = MatchEdges(result.reference, result.others, matching, &result.support);
  return result;
}

}
