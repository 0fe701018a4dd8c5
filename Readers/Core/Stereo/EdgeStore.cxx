// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/EdgeStore.h"

#include "Edges/MaskedEdges.h"
#include "Images/ImageMask.h"
#include "Images/LensDistortion.h"

#include <utility>
#include <vector>

namespace freespace
{

namespace
{

// Moves the tokens to where a camera without distortion would see them. Tangents turn with them. Tokens
// outside its field of view, at the rim of a fisheye image, are dropped.
EdgeChains Undistort(const CalibratedImage& image, EdgeChains edges, int minimumLength)
{
  if (image.IsPinhole() || edges.tokens.empty())
  {
    return edges;
  }
  constexpr double half = 0.5; // pixels along the edge, to either side
  std::vector<Eigen::Vector2d> points;
  points.reserve(3 * edges.tokens.size());
  for (const EdgeToken& token : edges.tokens)
  {
    for (const double step : { 0.0, -half, half })
    {
      points.push_back(token.position + step * token.tangent);
    }
  }
  const std::vector<Eigen::Vector2d> ideal = UndistortPixels(image, points);
  std::vector<char> unseen(edges.tokens.size(), 0);
  bool allSeen = true;
  for (std::size_t i = 0; i < edges.tokens.size(); ++i)
  {
    const Eigen::Vector2d along = ideal[3 * i + 2] - ideal[3 * i + 1];
    unseen[i] = !ideal[3 * i].allFinite() || !along.allFinite();
    allSeen = allSeen && !unseen[i];
    edges.tokens[i].position = ideal[3 * i];
    edges.tokens[i].tangent = along.normalized();
  }
  return allSeen ? edges : EdgesWithout(edges, unseen, minimumLength);
}

}

EdgeStore::EdgeStore(const Scene& scene, const EdgeTokenOptions& options, std::size_t mostTokens)
  : Source(scene)
  , Options(options)
  , Cache(mostTokens)
{
  options.Check();
}

std::shared_ptr<const EdgeChains> EdgeStore::Edges(const CalibratedImage& image)
{
  return this->Cache.Find(
    image, [&] { return this->Find(image); },
    [](const EdgeChains& edges) { return edges.tokens.size(); });
}

EdgeChains EdgeStore::Find(const CalibratedImage& image) const
{
  const int width = image.camera.width, height = image.camera.height;
  EdgeChains edges = FindEdges(this->Source.Pixels(image), this->Options);
  if (const std::string mask = this->Source.MaskPath(image.file); !mask.empty())
  {
    edges = EdgesOutside(edges, LoadMask(mask, width, height), this->Options.minimumLength);
  }
  return Undistort(image, std::move(edges), this->Options.minimumLength);
}

}
