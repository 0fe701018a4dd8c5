// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ProposeClusters.h"

#include "Common/Error.h"
#include "Scene/CenterIndex.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace freespace
{

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double radian = pi / 180;
constexpr std::size_t samplesPerImage = 300;

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Points that an image observes, about evenly taken from its list.
std::vector<int> SampleOf(const std::vector<int>& pointOf)
{
  std::vector<int> points;
  std::copy_if(pointOf.begin(), pointOf.end(), std::back_inserter(points),
    [](int point) { return point >= 0; });
  const std::size_t count = std::min(points.size(), samplesPerImage);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = points[i * points.size() / count];
  }
  points.resize(count);
  return points;
}

// A pair of the reference with one neighbour.
struct Neighbor
{
  int image = 0;
  double angle = 0; // radians
  double overlap = 0;
  double distance = 0;                                 // of the centres
  Eigen::Vector2d direction = Eigen::Vector2d::Zero(); // in the reference's picture, of length 1
  double quality = 0;
};

class Proposer
{
public:
  Proposer(const SparseModel& model, const ClusterProposalOptions& options)
    : Options(options)
    , Tracks(model)
    , Images(CalibratedImages(model))
    , Index(Centers(this->Images))
  {
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      this->Samples.push_back(this->PointsBefore(model, i));
    }
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      this->Depth.push_back(this->SceneDepth(i));
      if (this->Samples[i].empty())
      {
        this->Samples[i] = this->Screen(i);
      }
    }
  }

  std::vector<ProposedCluster> Propose() const
  {
    std::vector<std::vector<ProposedTriplet>> triplets;
    double best = 0;
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      triplets.push_back(this->Triplets(i));
      for (const ProposedTriplet& triplet : triplets.back())
      {
        best = std::max(best, triplet.quality);
      }
    }
    std::vector<ProposedCluster> clusters;
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      auto& own = triplets[i];
      own.erase(std::remove_if(own.begin(), own.end(),
                  [&](const ProposedTriplet& triplet)
                  { return triplet.quality < this->Options.leastQuality * best; }),
        own.end());
      if (!own.empty())
      {
        clusters.push_back(this->BestCluster(i, own));
      }
    }
    return this->Separated(std::move(clusters));
  }

private:
  static std::vector<Eigen::Vector3d> Centers(const std::vector<CalibratedImage>& images)
  {
    std::vector<Eigen::Vector3d> centers;
    for (const CalibratedImage& image : images)
    {
      centers.push_back(image.camera.Center());
    }
    return centers;
  }

  const Camera& CameraOf(std::size_t i) const { return this->Images[i].camera; }

  static Eigen::Vector3d Axis(const Camera& camera) { return camera.R.row(2); }

  // A sample of the model's points that an image sees.
  std::vector<Eigen::Vector3d> PointsBefore(const SparseModel& model, std::size_t image)
  {
    std::unordered_map<int, int> shared;
    std::vector<Eigen::Vector3d> points;
    for (int index : SampleOf(this->Tracks.pointOf[image]))
    {
      const Eigen::Vector3d& point = model.points[static_cast<std::size_t>(index)].position;
      if (this->CameraOf(image).Depth(point) > 0)
      {
        points.push_back(point);
        for (const SparseLink& link : this->Tracks.ofPoint[static_cast<std::size_t>(index)])
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
  double SceneDepth(std::size_t i) const
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
    return depths.empty() ? nearest / std::tan(this->Options.preferredAngle * radian)
                          : Median(std::move(depths));
  }

  // Depth on the first axis of the point nearest to the second, when they cross before the cameras.
  static std::optional<double> DepthOfAxes(const Camera& first, const Camera& second)
  {
    const Eigen::Vector3d a = Axis(first), b = Axis(second);
    const Eigen::Vector3d baseline = second.Center() - first.Center();
    const double angle = Angle(a, b);
    if (angle < 1 * radian || angle > 90 * radian)
    {
      return std::nullopt;
    }
    // The two normal equations of |s a - t b - baseline|^2.
    const double cosine = a.dot(b), along = a.dot(baseline), across = b.dot(baseline);
    const double s = (along - cosine * across) / (1 - cosine * cosine);
    const double t = (cosine * along - across) / (1 - cosine * cosine);
    return s > 0 && t > 0 ? std::optional<double>(s) : std::nullopt;
  }

  // A grid over the picture at the depth of the scene.
  std::vector<Eigen::Vector3d> Screen(std::size_t i) const
  {
    constexpr int steps = 9;
    const Camera& camera = this->CameraOf(i);
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k<steps * steps&& this->Depth[i]> 0; ++k)
    {
      const Eigen::Vector2d pixel(
        (k % steps + 0.5) * camera.width / steps, (k / steps + 0.5) * camera.height / steps);
      points.push_back(camera.Unproject(pixel, this->Depth[i]));
    }
    return points;
  }

  // What the axis meets at the depth of the scene.
  Eigen::Vector3d Target(std::size_t i) const
  {
    const Camera& camera = this->CameraOf(i);
    return camera.Unproject({ camera.width / 2.0, camera.height / 2.0 }, this->Depth[i]);
  }

  // The images nearest to the reference and nearest to where good neighbours would stand.
  std::vector<int> Candidates(std::size_t i) const
  {
    const Camera& camera = this->CameraOf(i);
    std::vector<int> candidates = this->Index.Nearest(camera.Center(), 17);
    const double distance = this->Depth[i] * std::tan(this->Options.preferredAngle * radian);
    for (int k = 0; k < 8; ++k)
    {
      const Eigen::Vector3d offset(std::cos(k * pi / 4), std::sin(k * pi / 4), 0);
      const std::vector<int> found =
        this->Index.Nearest(camera.Center() + distance * (camera.R.transpose() * offset), 4);
      candidates.insert(candidates.end(), found.begin(), found.end());
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    return candidates;
  }

  // Of the reference's points, the fraction that lies in a neighbour's picture. Where the model
  // knows that they have not a point in common, something stands between.
  double Overlap(std::size_t i, int j) const
  {
    const bool known = !this->Shared[i].empty();
    if (this->Samples[i].empty() || (known && !this->Shared[i].count(j)))
    {
      return 0;
    }
    const Camera& other = this->CameraOf(static_cast<std::size_t>(j));
    std::size_t seen = 0;
    for (const Eigen::Vector3d& point : this->Samples[i])
    {
      seen += other.Depth(point) > 0 && other.Sees(other.Project(point));
    }
    return static_cast<double>(seen) / static_cast<double>(this->Samples[i].size());
  }

  std::optional<Neighbor> Judge(std::size_t i, int j) const
  {
    const Camera& camera = this->CameraOf(i);
    const Camera& other = this->CameraOf(static_cast<std::size_t>(j));
    const Eigen::Vector3d target = this->Target(i), baseline = camera.FromWorld(other.Center());
    Neighbor neighbor;
    neighbor.image = j;
    neighbor.distance = baseline.norm();
    neighbor.angle = Angle(camera.Center() - target, other.Center() - target);
    // Outside the angles' range, or so far before the reference that the epipole is in the picture.
    const double sideways = baseline.head<2>().norm() / neighbor.distance;
    if (!(neighbor.angle >= this->Options.minimumAngle * radian) ||
      neighbor.angle > this->Options.maximumAngle * radian || sideways < 0.8)
    {
      return std::nullopt;
    }
    neighbor.overlap = this->Overlap(i, j);
    if (neighbor.overlap < this->Options.minimumOverlap)
    {
      return std::nullopt;
    }
    neighbor.direction = baseline.head<2>().normalized();
    neighbor.quality = neighbor.overlap * sideways * sideways * this->AngleQuality(neighbor.angle) *
      ScaleQuality(camera, other, target);
    return neighbor;
  }

  // 1 at the preferred angle; falls faster towards none than towards a wide one.
  double AngleQuality(double angle) const
  {
    const double preferred = this->Options.preferredAngle * radian;
    const double width = angle < preferred ? preferred / 2 : preferred;
    return std::exp(-0.5 * std::pow((angle - preferred) / width, 2));
  }

  // 1 when both show the target at the same size, 0.6 when one shows it half as large again.
  static double ScaleQuality(const Camera& a, const Camera& b, const Eigen::Vector3d& target)
  {
    const double ratio = a.K(0, 0) / a.Depth(target) * b.Depth(target) / b.K(0, 0);
    return ratio > 0 ? std::exp(-0.5 * std::pow(std::log(ratio) / std::log(1.5), 2)) : 0;
  }

  // All pairs of neighbours on opposite sides of an image.
  std::vector<ProposedTriplet> Triplets(std::size_t i) const
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
    std::vector<ProposedTriplet> triplets;
    for (std::size_t a = 0; a < neighbors.size(); ++a)
    {
      for (std::size_t b = a + 1; b < neighbors.size(); ++b)
      {
        const double straight = -neighbors[a].direction.dot(neighbors[b].direction);
        if (straight >= std::cos(30 * radian))
        {
          triplets.push_back(MakeTriplet(neighbors[a], neighbors[b], straight));
        }
      }
    }
    return triplets;
  }

  static ProposedTriplet MakeTriplet(const Neighbor& a, const Neighbor& b, double straight)
  {
    const bool horizontal = std::abs(a.direction.x()) >= std::abs(a.direction.y());
    const bool inOrder = (horizontal ? a.direction.x() : a.direction.y()) < 0;
    const Neighbor& first = inOrder ? a : b;
    const Neighbor& second = inOrder ? b : a;
    ProposedTriplet triplet;
    triplet.neighbors = { first.image, second.image };
    triplet.angle = { first.angle / radian, second.angle / radian };
    triplet.overlap = { first.overlap, second.overlap };
    triplet.quality = std::sqrt(a.quality * b.quality) * straight *
      std::min(a.distance, b.distance) / std::max(a.distance, b.distance);
    return triplet;
  }

  // The direction of a triplet in the reference's picture.
  Eigen::Vector2d Direction(std::size_t reference, const ProposedTriplet& triplet) const
  {
    const Camera& camera = this->CameraOf(reference);
    const auto position = [&](int image)
    { return camera.FromWorld(this->CameraOf(static_cast<std::size_t>(image)).Center()); };
    return (position(triplet.neighbors[1]) - position(triplet.neighbors[0])).head<2>().normalized();
  }

  ProposedCluster BestCluster(
    std::size_t reference, const std::vector<ProposedTriplet>& triplets) const
  {
    ProposedCluster best;
    best.reference = static_cast<int>(reference);
    for (const ProposedTriplet& first : triplets)
    {
      if (first.quality > best.quality)
      {
        best.triplets = { first };
        best.quality = first.quality;
      }
      const Eigen::Vector2d direction = this->Direction(reference, first);
      for (const ProposedTriplet& second : triplets)
      {
        const double cosine = direction.dot(this->Direction(reference, second));
        const double quality = first.quality + second.quality * (1 - cosine * cosine);
        const bool disjoint = first.neighbors[0] != second.neighbors[0] &&
          first.neighbors[0] != second.neighbors[1] && first.neighbors[1] != second.neighbors[0] &&
          first.neighbors[1] != second.neighbors[1];
        if (disjoint && std::abs(cosine) < std::cos(45 * radian) && quality > best.quality)
        {
          best.triplets = { first, second };
          best.quality = quality;
        }
      }
    }
    return best;
  }

  // The best first, each taking those out whose reference stands too near and looks the same way.
  std::vector<ProposedCluster> Separated(std::vector<ProposedCluster> clusters) const
  {
    std::stable_sort(clusters.begin(), clusters.end(),
      [](const ProposedCluster& a, const ProposedCluster& b) { return a.quality > b.quality; });
    std::vector<bool> taken(this->Images.size(), false);
    std::vector<ProposedCluster> chosen;
    for (ProposedCluster& cluster : clusters)
    {
      const std::size_t reference = static_cast<std::size_t>(cluster.reference);
      if (taken[reference])
      {
        continue;
      }
      const Camera& camera = this->CameraOf(reference);
      const double radius = this->Depth[reference] * std::tan(this->Options.separation * radian);
      for (int near : this->Index.Within(camera.Center(), radius))
      {
        const Camera& other = this->CameraOf(static_cast<std::size_t>(near));
        taken[static_cast<std::size_t>(near)] =
          taken[static_cast<std::size_t>(near)] || Angle(Axis(camera), Axis(other)) < 30 * radian;
      }
      chosen.push_back(std::move(cluster));
    }
    std::sort(chosen.begin(), chosen.end(),
      [](const ProposedCluster& a, const ProposedCluster& b) { return a.reference < b.reference; });
    return chosen;
  }

  ClusterProposalOptions Options;
  SparseTracks Tracks;
  std::vector<CalibratedImage> Images;
  CenterIndex Index;
  std::vector<std::unordered_map<int, int>> Shared; // per image: how many of its samples others see
  std::vector<std::vector<Eigen::Vector3d>> Samples; // per image: of the surface before it
  std::vector<double> Depth;                         // per image, of the scene
};

// Without its folder and its ending.
std::string Stem(const std::string& image)
{
  return std::filesystem::path(image).stem().string();
}

}

void ClusterProposalOptions::Check() const
{
  if (!(this->minimumAngle > 0 && this->minimumAngle <= this->preferredAngle &&
        this->preferredAngle <= this->maximumAngle && this->maximumAngle < 90))
  {
    throw Error("The angles of neighbours must be positive and below 90 degrees, the preferred one "
                "between the least and the greatest.");
  }
  if (!(this->minimumOverlap >= 0 && this->minimumOverlap <= 1) ||
    !(this->leastQuality >= 0 && this->leastQuality <= 1))
  {
    throw Error("The overlap and the least quality of neighbours must be in [0, 1].");
  }
  if (!(this->separation >= 0 && this->separation < 90))
  {
    throw Error("The separation of references must be at least 0 and below 90 degrees.");
  }
}

std::vector<ProposedCluster> ProposeClusters(
  const SparseModel& model, const ClusterProposalOptions& options)
{
  options.Check();
  return Proposer(model, options).Propose();
}

std::vector<Cluster> ClustersFromProposal(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal)
{
  const auto name = [&](int image) { return model.images[static_cast<std::size_t>(image)].name; };
  std::unordered_map<std::string, int> uses;
  for (const ProposedCluster& proposed : proposal)
  {
    ++uses[Stem(name(proposed.reference))];
  }
  std::vector<Cluster> clusters;
  for (const ProposedCluster& proposed : proposal)
  {
    Cluster& cluster = clusters.emplace_back();
    cluster.reference = name(proposed.reference);
    cluster.name = Stem(cluster.reference);
    if (uses[cluster.name] > 1) // in several folders
    {
      cluster.name = cluster.reference;
      std::replace(cluster.name.begin(), cluster.name.end(), '/', '_');
    }
    for (const ProposedTriplet& triplet : proposed.triplets)
    {
      cluster.triplets.push_back(
        { name(triplet.neighbors[0]), cluster.reference, name(triplet.neighbors[1]) });
    }
  }
  return clusters;
}

std::string DescribeProposal(const SparseModel& model, const std::vector<ProposedCluster>& proposal)
{
  const auto name = [&](int image) { return model.images[static_cast<std::size_t>(image)].name; };
  std::string text;
  for (const ProposedCluster& cluster : proposal)
  {
    text += name(cluster.reference) + (cluster.triplets.size() == 2 ? ": cross" : ": row") + "\n";
    for (const ProposedTriplet& triplet : cluster.triplets)
    {
      char figures[100];
      std::snprintf(figures, sizeof(figures), "%.1f and %.1f degrees, overlap %.2f and %.2f",
        triplet.angle[0], triplet.angle[1], triplet.overlap[0], triplet.overlap[1]);
      text += "  " + name(triplet.neighbors[0]) + " | " + name(triplet.neighbors[1]) + "  " +
        figures + "\n";
    }
  }
  return text;
}

SparseModel WithExistingPhotographs(const Scene& scene, SparseModel model)
{
  if (!std::filesystem::is_directory(scene.ImagesFolder()))
  {
    return model;
  }
  model.images.erase(std::remove_if(model.images.begin(), model.images.end(),
                       [&](const SparseImage& image)
                       { return !std::filesystem::exists(scene.ImagePath(image.name)); }),
    model.images.end());
  return model;
}

Scene ReadSceneWithClusters(const std::string& file, const ClusterProposalOptions& options)
{
  Scene scene = ReadScene(file);
  if (scene.clusters.empty())
  {
    const SparseModel model = WithExistingPhotographs(scene, ReadSceneModel(scene));
    scene.clusters = ClustersFromProposal(model, ProposeClusters(model, options));
    if (scene.clusters.empty())
    {
      throw Error("The scene " + file +
        " has no clusters, and none can be proposed: no photograph "
        "has neighbours on opposite sides that see the same.");
    }
  }
  return scene;
}

}
