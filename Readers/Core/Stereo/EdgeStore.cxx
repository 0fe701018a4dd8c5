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

bool HaveSameLens(const CalibratedImage& a, const CalibratedImage& b)
{
  return a.camera.K == b.camera.K && a.distortion == b.distortion;
}

}

EdgeStore::EdgeStore(const Scene& scene, const EdgeTokenOptions& options, std::size_t mostTokens)
  : Source(scene)
  , Options(options)
  , MostTokens(mostTokens)
{
  options.Check();
}

std::shared_ptr<const EdgeChains> EdgeStore::Edges(const CalibratedImage& image)
{
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::shared_ptr<Entry>& known = this->Entries[image.file];
    if (!known)
    {
      known = std::make_shared<Entry>();
    }
    entry = known;
  }
  const std::lock_guard<std::mutex> busy(entry->mutex);
  std::shared_ptr<const EdgeChains> edges;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    edges = HaveSameLens(entry->image, image) ? entry->edges : nullptr;
  }
  if (!edges)
  {
    const int width = image.camera.width, height = image.camera.height;
    auto found = std::make_shared<EdgeChains>(
      FindEdges(LoadImage(this->Source.ImagePath(image.file), width, height), this->Options));
    if (const std::string mask = this->Source.MaskPath(image.file); !mask.empty())
    {
      *found = EdgesOutside(*found, LoadMask(mask, width, height), this->Options.minimumLength);
    }
    Undistort(image, *found);
    edges = std::move(found);
    entry->image = image;
  }
  this->Note(*entry, edges);
  return edges;
}

// Keeps the edges, and lets go of those that were not asked for longest.
void EdgeStore::Note(Entry& entry, const std::shared_ptr<const EdgeChains>& edges)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto letGo = [this](Entry& old)
  {
    this->Tokens -= old.edges->tokens.size();
    this->Kept.erase(old.lastUse);
    old.edges.reset();
  };
  if (entry.edges)
  {
    letGo(entry);
  }
  entry.edges = edges;
  entry.lastUse = ++this->Uses;
  this->Kept[entry.lastUse] = &entry;
  this->Tokens += edges->tokens.size();
  while (this->Tokens > this->MostTokens && this->Kept.size() > 1)
  {
    letGo(*this->Kept.begin()->second);
  }
}

}
