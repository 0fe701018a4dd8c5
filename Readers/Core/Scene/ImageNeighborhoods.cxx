// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ImageNeighborhoods.h"

#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace freespace
{

namespace
{

constexpr std::size_t SamplesPerImage = 300;
constexpr std::size_t MostNeighbors = 16;

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d Axis(const Camera& camera)
{
  return camera.R.row(2);
}

std::vector<Eigen::Vector3d> Centers(const std::vector<CalibratedImage>& images)
{
  std::vector<Eigen::Vector3d> centers;
  for (const CalibratedImage& image : images)
  {
    centers.push_back(image.camera.Center());
  }
  return centers;
}

// A sample of the points that an image observes, evenly chosen from its list.
std::vector<int> SampleOf(const std::vector<int>& pointOf)
{
  std::vector<int> points;
  std::copy_if(pointOf.begin(), pointOf.end(), std::back_inserter(points),
    [](int point) { return point >= 0; });
  const std::size_t count = std::min(points.size(), SamplesPerImage);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = points[i * points.size() / count];
  }
  points.resize(count);
  return points;
}

// Depth on the first axis of the point nearest to the second, when they cross before the cameras.
std::optional<double> DepthOfAxes(const Camera& first, const Camera& second)
{
  const Eigen::Vector3d a = Axis(first), b = Axis(second);
  const Eigen::Vector3d baseline = second.Center() - first.Center();
  const double angle = Angle(a, b);
  if (angle < 1 * degree || angle > 90 * degree)
  {
    return std::nullopt;
  }
  // The two normal equations of |s a - t b - baseline|^2.
  const double cosine = a.dot(b), along = a.dot(baseline), across = b.dot(baseline);
  const double s = (along - cosine * across) / (1 - cosine * cosine);
  const double t = (cosine * along - across) / (1 - cosine * cosine);
  return s > 0 && t > 0 ? std::optional<double>(s) : std::nullopt;
}

// 1 when both show the target at the same size, 0.6 when one shows it half as large again.
double ScaleQuality(const Camera& a, const Camera& b, const Eigen::Vector3d& target)
{
  const double ratio = a.K(0, 0) / a.Depth(target) * b.Depth(target) / b.K(0, 0);
  return ratio > 0 ? std::exp(-0.5 * std::pow(std::log(ratio) / std::log(1.5), 2)) : 0;
}

// The sine between the axis and a baseline whose epipole is just outside the image.
double LeastSideways(const Camera& camera)
{
  const double diagonal = 0.5 * std::hypot(camera.width, camera.height);
  return std::max(0.5, std::sin(std::atan2(diagonal, camera.K(0, 0))));
}

}

ImageNeighborhoods::ImageNeighborhoods(
  const SparseModel& model, const ClusterProposalOptions& options)
  : Options(options)
  , Images(CalibratedImages(model))
  , Index(Centers(this->Images))
{
  const SparseTracks tracks(model);
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    this->Samples.push_back(this->PointsBefore(model, tracks, i));
  }
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    this->Depths.push_back(this->SceneDepth(i));
    if (this->Samples[i].empty())
    {
      this->Samples[i] = this->Screen(i);
    }
  }
}

std::vector<Neighbor> ImageNeighborhoods::NeighborsOf(std::size_t i) const
{
  std::vector<Neighbor> neighbors;
  for (int j : this->Candidates(i))
  {
    const std::optional<Neighbor> neighbor = this->Judge(i, j);
    if (neighbor && neighbor->quality > 0)
    {
      neighbors.push_back(*neighbor);
    }
  }
  std::stable_sort(neighbors.begin(), neighbors.end(),
    [](const Neighbor& a, const Neighbor& b) { return a.quality > b.quality; });
  neighbors.resize(std::min(neighbors.size(), MostNeighbors));
  return neighbors;
}

double ImageNeighborhoods::Overlap(std::size_t i, std::size_t j) const
{
  const bool known = !this->Shared[i].empty();
  if (this->Samples[i].empty() || (known && !this->Shared[i].count(static_cast<int>(j))))
  {
    return 0;
  }
  const Camera& other = this->CameraOf(j);
  std::size_t seen = 0;
  for (const Eigen::Vector3d& point : this->Samples[i])
  {
    seen += other.Depth(point) > 0 && other.Sees(other.Project(point));
  }
  return static_cast<double>(seen) / static_cast<double>(this->Samples[i].size());
}

double ImageNeighborhoods::AngleBetween(std::size_t i, std::size_t j) const
{
  const Eigen::Vector3d target = this->Target(i);
  return Angle(this->CameraOf(i).Center() - target, this->CameraOf(j).Center() - target);
}

std::vector<int> ImageNeighborhoods::Within(std::size_t i, double angle) const
{
  return this->Index.Within(this->CameraOf(i).Center(), this->Depths[i] * std::tan(angle));
}

// A sample of the model's points that an image sees.
std::vector<Eigen::Vector3d> ImageNeighborhoods::PointsBefore(
  const SparseModel& model, const SparseTracks& tracks, std::size_t image)
{
  std::unordered_map<int, int> shared;
  std::vector<Eigen::Vector3d> points;
  for (int index : SampleOf(tracks.pointOf[image]))
  {
    const Eigen::Vector3d& point = model.points[static_cast<std::size_t>(index)].position;
    if (this->CameraOf(image).Depth(point) > 0)
    {
      points.push_back(point);
      for (const SparseLink& link : tracks.ofPoint[static_cast<std::size_t>(index)])
      {
        ++shared[link.image];
      }
    }
  }
  this->Shared.push_back(std::move(shared));
  return points;
}

// Along the optical axis. From its points, or from where the axes of the neighbours pass nearest
// to its own; with parallel axes, such that the nearest neighbour is at the preferred angle.
double ImageNeighborhoods::SceneDepth(std::size_t i) const
{
  const Camera& camera = this->CameraOf(i);
  std::vector<double> depths;
  for (const Eigen::Vector3d& point : this->Samples[i])
  {
    depths.push_back(camera.Depth(point));
  }
  double nearest = 0;
  if (depths.empty())
  {
    for (int j : this->Index.Nearest(camera.Center(), 32))
    {
      const Camera& other = this->CameraOf(static_cast<std::size_t>(j));
      const double distance = (other.Center() - camera.Center()).norm();
      nearest = nearest > 0 ? nearest : distance;
      if (const std::optional<double> depth = DepthOfAxes(camera, other))
      {
        depths.push_back(*depth);
      }
    }
  }
  return MedianOr(std::move(depths), nearest / std::tan(this->Options.preferredAngle * degree));
}

// A grid over the image at the depth of the scene.
std::vector<Eigen::Vector3d> ImageNeighborhoods::Screen(std::size_t i) const
{
  constexpr int steps = 9;
  const Camera& camera = this->CameraOf(i);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k<steps * steps&& this->Depths[i]> 0; ++k)
  {
    const Eigen::Vector2d pixel(
      (k % steps + 0.5) * camera.width / steps, (k / steps + 0.5) * camera.height / steps);
    points.push_back(camera.Unproject(pixel, this->Depths[i]));
  }
  return points;
}

// The point on the axis at the depth of the scene.
Eigen::Vector3d ImageNeighborhoods::Target(std::size_t i) const
{
  const Camera& camera = this->CameraOf(i);
  return camera.Unproject({ camera.width / 2.0, camera.height / 2.0 }, this->Depths[i]);
}

// The images nearest to the reference and nearest to the ideal positions of neighbours: at the
// preferred angle, and at twice that.
std::vector<int> ImageNeighborhoods::Candidates(std::size_t i) const
{
  const Camera& camera = this->CameraOf(i);
  std::vector<int> candidates = this->Index.Nearest(camera.Center(), 17);
  for (int k = 0; k < 16; ++k)
  {
    const double angle = this->Options.preferredAngle * degree * (k < 8 ? 1 : 2);
    const double distance = this->Depths[i] * std::tan(std::min(angle, 45 * degree));
    const Eigen::Vector3d offset(std::cos(k * M_PI / 4), std::sin(k * M_PI / 4), 0);
    const std::vector<int> found =
      this->Index.Nearest(camera.Center() + distance * (camera.R.transpose() * offset), 4);
    candidates.insert(candidates.end(), found.begin(), found.end());
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return candidates;
}

std::optional<Neighbor> ImageNeighborhoods::Judge(std::size_t i, int j) const
{
  const Camera& camera = this->CameraOf(i);
  const Camera& other = this->CameraOf(static_cast<std::size_t>(j));
  const Eigen::Vector3d baseline = camera.FromWorld(other.Center());
  Neighbor neighbor;
  neighbor.image = j;
  neighbor.distance = baseline.norm();
  neighbor.angle = this->AngleBetween(i, static_cast<std::size_t>(j));
  // Outside the angles' range, or so far before the reference that the epipole is in the image.
  const double sideways = baseline.head<2>().norm() / neighbor.distance;
  if (!(neighbor.angle >= this->Options.minimumAngle * degree) ||
    neighbor.angle > this->Options.maximumAngle * degree || sideways < LeastSideways(camera))
  {
    return std::nullopt;
  }
  neighbor.overlap = this->Overlap(i, static_cast<std::size_t>(j));
  if (neighbor.overlap < this->Options.minimumOverlap)
  {
    return std::nullopt;
  }
  neighbor.direction = baseline.head<2>().normalized();
  neighbor.quality = neighbor.overlap * sideways * sideways * this->AngleQuality(neighbor.angle) *
    ScaleQuality(camera, other, this->Target(i));
  return neighbor;
}

// 1 at the preferred angle, 0.6 at 2.2 times as much or as little: others are less
// preferred, and used where the set has nothing else.
double ImageNeighborhoods::AngleQuality(double angle) const
{
  const double ratio = angle / (this->Options.preferredAngle * degree);
  return std::exp(-0.5 * std::pow(std::log(ratio) / std::log(2.2), 2));
}

}
