// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ChanceMatches.h"

#include "Common/Error.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace freespace
{

namespace
{

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Tokens that a right image has confirmed at least, and how many times as many as by chance. Measured: right images of
// a pattern that repeats, 8 to 100 times; wrong ones, 0 to 4 times.
constexpr double LeastTokens = 30;
constexpr double TimesChance = 5;

// Rotations about a camera's centre after which its image fits no other.
std::array<Matrix3d, 3> Turns()
{
  constexpr double angle = 0.15; // radians, some 100 pixels
  return { Matrix3d(Vector3d(-1, -1, 1).asDiagonal()),
    AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix(),
    AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix() };
}

}

bool ExceedsChance(const std::vector<CalibratedImage>& images, const Cluster& cluster,
  const ImageAgreement& agreement, const ClusterMeasure& measure)
{
  double chance = 0;
  std::vector<CalibratedImage> turned = images;
  const std::size_t image = static_cast<std::size_t>(agreement.image);
  for (const Matrix3d& turn : Turns())
  {
    turned[image].camera.R = turn * images[image].camera.R;
    turned[image].camera.t = turn * images[image].camera.t;
    try
    {
      chance = std::max(chance, measure(turned, cluster).confirmed);
    }
    catch (const Error&) // it sees nothing that the others see
    {
    }
  }
  return agreement.confirmed >= LeastTokens + TimesChance * chance;
}

std::vector<int> ConfirmedByEachOther(const std::vector<ImageAgreement>& agreements)
{
  std::vector<int> confirmed;
  for (const ImageAgreement& own : agreements)
  {
    const auto companions = std::count_if(agreements.begin(), agreements.end(),
      [&own](const ImageAgreement& agreement)
      {
        return std::any_of(own.others.begin(), own.others.end(),
          [&agreement](const auto& other)
          { return other.first == agreement.image && other.second > 0; });
      });
    if (companions >= 2)
    {
      confirmed.push_back(own.image);
    }
  }
  std::sort(confirmed.begin(), confirmed.end());
  return confirmed;
}

}
