// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/EdgeStereo.h"

#include "Common/Error.h"
#include "Epipolar/DisparityRange.h"
#include "Images/ImageFile.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

const CalibratedImage& FindImage(
  const std::vector<CalibratedImage>& images, const std::string& file, const Cluster& cluster)
{
  const auto found = std::find_if(
    images.begin(), images.end(), [&](const CalibratedImage& image) { return image.file == file; });
  if (found == images.end())
  {
    throw Error("Cluster '" + cluster.name + "' names the image " + file +
      ", which the camera model does not have.");
  }
  return *found;
}

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

ImageEdges EdgesOfImage(
  const Scene& scene, const CalibratedImage& image, const EdgeTokenOptions& options)
{
  ImageEdges result{ image.camera,
    FindEdges(
      LoadImage(scene.ImagePath(image.file), image.camera.width, image.camera.height), options) };
  Undistort(image, result.edges);
  return result;
}

// The disparities that the options ask for and that some triplet of the cluster can see.
DisparityRange SearchRange(
  const std::vector<CalibratedImage>& images, const Cluster& cluster, const MatcherOptions& options)
{
  DisparityRange all{ std::numeric_limits<double>::infinity(), 0 };
  for (const auto& triplet : cluster.triplets)
  {
    const DisparityRange range = CommonRange(FindImage(images, triplet[1], cluster).camera,
      FindImage(images, triplet[0], cluster).camera, FindImage(images, triplet[2], cluster).camera,
      { options.minimumDisparity, options.maximumDisparity });
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

// The images beside the reference, each once.
std::vector<std::string> OtherImages(const Cluster& cluster)
{
  std::vector<std::string> others;
  for (const auto& triplet : cluster.triplets)
  {
    for (const std::string& file : { triplet[0], triplet[2] })
    {
      if (std::find(others.begin(), others.end(), file) == others.end())
      {
        others.push_back(file);
      }
    }
  }
  return others;
}

// Slope of the points along a chain, over `radius` neighbours to either side.
Eigen::Vector3d DirectionAlong(
  const std::vector<Eigen::Vector3d>& points, const std::vector<int>& chain, int k, int radius)
{
  const int begin = std::max(0, k - radius);
  const int end = std::min(static_cast<int>(chain.size()) - 1, k + radius);
  const double middle = 0.5 * (begin + end);
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int j = begin; j <= end; ++j)
  {
    slope += (j - middle) * points[chain[j]];
  }
  return slope.normalized();
}

void AddFeature(const EdgeToken& token, const EdgeMatch& match, EdgeView& view)
{
  view.points.push_back(view.camera.Unproject(match.imagePoint, 1 / match.disparity));
  view.imagePoints.push_back(match.imagePoint);
  view.colors.push_back({ token.color[2], token.color[1], token.color[0] });
  view.matchingCosts.push_back(match.cost);
}

// Turns matches into features and runs into chains.
void FillView(const EdgeChains& edges, const LargeVector<EdgeMatch>& matches, EdgeView& view)
{
  int run = -1;
  for (std::size_t i = 0; i < matches.size(); ++i)
  {
    if (matches[i].images == 0 || !view.camera.Sees(matches[i].imagePoint))
    {
      continue;
    }
    if (matches[i].run != run)
    {
      run = matches[i].run;
      view.chains.emplace_back();
    }
    view.chains.back().push_back(static_cast<int>(view.points.size()));
    view.chainIds.push_back(static_cast<int>(view.chains.size()) - 1);
    AddFeature(edges.tokens[i], matches[i], view);
  }
  view.edgeDirections.resize(view.points.size());
  for (const std::vector<int>& chain : view.chains)
  {
    for (int k = 0; k < static_cast<int>(chain.size()); ++k)
    {
      view.edgeDirections[chain[k]] = DirectionAlong(view.points, chain, k, 4);
    }
  }
}

}

void EdgeStereoOptions::Check() const
{
  this->edges.Check();
  this->matching.Check();
}

EdgeView FindFeatures(const Scene& scene, const std::vector<CalibratedImage>& images,
  const Cluster& cluster, const EdgeStereoOptions& options, const CancellationFlag& stop)
{
  options.Check();
  const CalibratedImage& referenceImage = FindImage(images, cluster.reference, cluster);
  MatcherOptions matching = options.matching;
  const DisparityRange range = SearchRange(images, cluster, matching);
  matching.minimumDisparity = range.minimum;
  matching.maximumDisparity = range.maximum;

  const ImageEdges reference = EdgesOfImage(scene, referenceImage, options.edges);
  std::vector<ImageEdges> others;
  for (const std::string& file : OtherImages(cluster))
  {
    ThrowIfCancelled(stop);
    others.push_back(EdgesOfImage(scene, FindImage(images, file, cluster), options.edges));
  }

  ThrowIfCancelled(stop);
  EdgeView view;
  view.name = cluster.name;
  view.imageFile = cluster.reference;
  view.camera = referenceImage.camera;
  FillView(reference.edges, MatchEdges(reference, others, matching), view);
  if (view.points.size() < 3)
  {
    throw Error("Cluster '" + cluster.name +
      "' has fewer than three features in its reference image " +
      scene.ImagePath(cluster.reference) + ".");
  }
  return view;
}

}
