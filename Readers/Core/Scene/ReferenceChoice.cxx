// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ReferenceChoice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freespace
{

namespace
{

// A reference that sees so much of what an image sees, and looks about the same way, can stand for it.
constexpr double SameSight = 0.6;
constexpr double SameWay = 30 * degree;

// How well the references chosen so far cover an image.
struct Covered
{
  double nearest = std::numeric_limits<double>::infinity(); // angle to the nearest one, radians
  int references = 0;                                       // within the coverage angle
};

double AngleOfAxes(const Camera& a, const Camera& b)
{
  return std::acos(std::clamp(a.R.row(2).dot(b.R.row(2)), -1.0, 1.0));
}

// Adds a reference to the coverage of its surroundings.
void Cover(const ImageNeighborhoods& images, int reference, double reach, double farthest,
  std::vector<Covered>& covered)
{
  const std::size_t r = static_cast<std::size_t>(reference);
  for (int near : images.Within(r, reach))
  {
    const std::size_t i = static_cast<std::size_t>(near);
    if (AngleOfAxes(images.CameraOf(i), images.CameraOf(r)) > SameWay ||
      (near != reference && images.Overlap(i, r) < SameSight))
    {
      continue;
    }
    const double distance = (images.CameraOf(i).Center() - images.CameraOf(r).Center()).norm();
    const double angle = std::atan2(distance, images.Depth(r));
    covered[i].nearest = std::min(covered[i].nearest, angle);
    covered[i].references += angle <= farthest;
  }
}

}

std::vector<int> ChooseReferences(const ImageNeighborhoods& images,
  std::vector<PossibleReference> possible, const ClusterProposalOptions& options)
{
  std::stable_sort(possible.begin(), possible.end(),
    [](const PossibleReference& a, const PossibleReference& b) { return a.quality > b.quality; });
  const bool limited = options.coverage > 0 && options.separation > 0 &&
    possible.size() > static_cast<std::size_t>(options.smallSet);
  const double farthest = options.coverageAngle * degree;
  const double least = options.separation * degree;
  std::vector<Covered> covered(images.Size());
  std::vector<int> chosen;
  double separation = limited ? std::max(farthest, least) : least;
  for (bool last = false; !last; separation = std::max(least, separation / std::sqrt(2)))
  {
    last = separation <= least;
    std::vector<PossibleReference> left;
    for (const PossibleReference& reference : possible)
    {
      const Covered& now = covered[static_cast<std::size_t>(reference.image)];
      if (limited && now.references >= options.coverage)
      {
        continue; // and so for good
      }
      if (now.nearest < separation)
      {
        left.push_back(reference);
        continue;
      }
      chosen.push_back(reference.image);
      if (options.separation > 0)
      {
        Cover(images, reference.image, std::max(separation, farthest), farthest, covered);
      }
    }
    possible = std::move(left);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}
