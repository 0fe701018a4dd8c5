// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/EdgeStore.h"

#include "Edges/MaskedEdges.h"
#include "Images/ImageFile.h"
#include "Images/ImageMask.h"

#include <opencv2/calib3d.hpp>

#include <vector>

namespace freespace
{

namespace
{

// Moves the tokens to where a camera without distortion would see them. Tangents turn with them.
void Undistort(const CalibratedImage& image, EdgeChains& edges)
{
  if (image.distortion.empty() || edges.tokens.empty())
  {
    return;
  }
  constexpr double half = 0.5; // pixels along the edge, to either side
  std::vector<cv::Point2d> points, ideal;
  for (const EdgeToken& token : edges.tokens)
  {
    for (const double step : { 0.0, -half, half })
    {
      const Eigen::Vector2d p = token.position + step * token.tangent;
      points.emplace_back(p.x(), p.y());
    }
  }
  const Eigen::Matrix3d& K = image.camera.K;
  const cv::Matx33d intrinsics(
    K(0, 0), K(0, 1), K(0, 2), K(1, 0), K(1, 1), K(1, 2), K(2, 0), K(2, 1), K(2, 2));
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-10);
  cv::undistortPoints(
    points, ideal, intrinsics, image.distortion, cv::noArray(), intrinsics, criteria);
  for (std::size_t i = 0; i < edges.tokens.size(); ++i)
  {
    const cv::Point2d& center = ideal[3 * i];
    const cv::Point2d along = ideal[3 * i + 2] - ideal[3 * i + 1];
    edges.tokens[i].position = { center.x, center.y };
    edges.tokens[i].tangent = Eigen::Vector2d(along.x, along.y).normalized();
  }
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
  EdgeChains edges =
    FindEdges(LoadImage(this->Source.ImagePath(image.file), width, height), this->Options);
  if (const std::string mask = this->Source.MaskPath(image.file); !mask.empty())
  {
    edges = EdgesOutside(edges, LoadMask(mask, width, height), this->Options.minimumLength);
  }
  Undistort(image, edges);
  return edges;
}

}
