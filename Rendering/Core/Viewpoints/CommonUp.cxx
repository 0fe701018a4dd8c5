// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/CommonUp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace freespace
{

namespace
{

constexpr double steadiness = 6 * M_PI / 180; // of the roll of a camera in the hand
constexpr std::size_t mostCameras = 100;      // considered, evenly chosen

/// A way to hold a camera, by where up is in the image, from its own up towards its right.
struct Hold
{
  double roll;
  double share; // of images
};

constexpr std::array<Hold, 4> holds = { Hold{ 0, 0.6 }, Hold{ M_PI / 2, 0.14 },
  Hold{ -M_PI / 2, 0.14 }, Hold{ M_PI, 0.02 } };
constexpr double anyhow = 0.1;

/// How a camera sees a direction.
struct Sight
{
  double roll;
  double spread; // of the roll, which is undetermined along the line of sight

  Sight(const Camera& camera, const Eigen::Vector3d& up)
  {
    const double above = -camera.R.row(1).dot(up);
    const double right = camera.R.row(0).dot(up);
    this->roll = std::atan2(right, above);
    this->spread = steadiness / std::max(std::hypot(above, right), 1e-3);
  }

  // Density of the roll if the camera was held like that.
  double Likelihood(const Hold& hold) const
  {
    constexpr double blind = 1 / (2 * M_PI);
    if (this->spread > 1)
    {
      return hold.share * blind;
    }
    const double off = std::remainder(this->roll - hold.roll, 2 * M_PI) / this->spread;
    return hold.share * std::max(std::exp(-off * off / 2) * std::sqrt(blind) / this->spread, 0.0);
  }
};

double LogLikelihood(const std::vector<const Camera*>& cameras, const Eigen::Vector3d& up)
{
  double sum = 0;
  for (const Camera* camera : cameras)
  {
    const Sight sight(*camera, up);
    double density = anyhow / (2 * M_PI);
    for (const Hold& hold : holds)
    {
      density += sight.Likelihood(hold);
    }
    sum += std::log(density);
  }
  return sum;
}

std::vector<const Camera*> SomeOf(const std::vector<Camera>& cameras)
{
  const std::size_t count = std::min(cameras.size(), mostCameras);
  std::vector<const Camera*> some;
  for (std::size_t i = 0; i < count; ++i)
  {
    some.push_back(&cameras[i * cameras.size() / count]);
  }
  return some;
}

// The images' own directions, exactly, and the sphere three degrees apart.
std::vector<Eigen::Vector3d> Candidates(const std::vector<const Camera*>& cameras)
{
  std::vector<Eigen::Vector3d> candidates;
  for (const Camera* camera : cameras)
  {
    candidates.emplace_back(-camera->R.row(1));
    candidates.emplace_back(camera->R.row(0));
    candidates.emplace_back(-camera->R.row(0));
  }
  constexpr int count = 5000; // a spiral at the golden angle
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / count;
    const double angle = M_PI * (1 + std::sqrt(5.0)) * i;
    const double radius = std::sqrt(1 - z * z);
    candidates.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return candidates;
}

// Moves up to where the images' level directions, each weighed by how sure it is, are most level; not where
// they do not tell.
Eigen::Vector3d Levelled(const std::vector<const Camera*>& cameras, Eigen::Vector3d up)
{
  for (int round = 0; round < 5; ++round)
  {
    Eigen::Matrix3d tilt = 1e-4 * Eigen::Matrix3d::Identity();
    for (const Camera* camera : cameras)
    {
      const Sight sight(*camera, up);
      for (const Hold& hold : holds)
      {
        const bool onSide = std::abs(std::cos(hold.roll)) < 0.5;
        const Eigen::Vector3d level = camera->R.row(onSide ? 1 : 0);
        const double sure = sight.spread < 1 ? sight.Likelihood(hold) * sight.spread : 0;
        tilt += sure * level * level.transpose() / cameras.size();
      }
    }
    // What is left of up without its part in directions that are known to be level.
    up = (1e-4 * tilt.ldlt().solve(up)).normalized();
  }
  return up;
}

// Cameras that are all held on one side know up from down no better than the other way round; then more look
// down than up.
Eigen::Vector3d RightWayUp(const std::vector<const Camera*>& cameras, const Eigen::Vector3d& up)
{
  double ahead = 0;
  for (const Camera* camera : cameras)
  {
    ahead += camera->R.row(2).dot(up) / cameras.size();
  }
  const double surer = LogLikelihood(cameras, up) - LogLikelihood(cameras, -up);
  return ahead > 0.01 && surer < 0.01 * cameras.size() ? Eigen::Vector3d(-up) : up;
}

}

Eigen::Vector3d CommonUp(const std::vector<Camera>& cameras)
{
  if (cameras.empty())
  {
    return Eigen::Vector3d::Zero();
  }
  const std::vector<const Camera*> some = SomeOf(cameras);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double most = 0;
  for (const Eigen::Vector3d& candidate : Candidates(some))
  {
    const double likelihood = LogLikelihood(some, candidate);
    if (best.isZero() || likelihood > most)
    {
      best = candidate;
      most = likelihood;
    }
  }
  return RightWayUp(some, Levelled(some, best));
}

}
