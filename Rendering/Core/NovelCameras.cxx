// SPDX-License-Identifier: BSD-3-Clause
#include "NovelCameras.h"

#include "LookAt.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr double degree = M_PI / 180;

/// Where a camera is, as seen from the middle.
struct Place
{
  Eigen::Vector3d direction;
  double distance = 0;
};

std::vector<Place> PlacesAround(const std::vector<Camera>& cameras, const Eigen::Vector3d& middle)
{
  std::vector<Place> places;
  for (const Camera& camera : cameras)
  {
    const Eigen::Vector3d from = camera.Center() - middle;
    if (from.norm() > 0)
    {
      places.push_back({ from.normalized(), from.norm() });
    }
  }
  return places;
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Up is across the line of sight, so that looking straight down has one, too.
Eigen::Vector3d UpFor(const Eigen::Vector3d& direction, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d across = up - up.dot(direction) * direction;
  return across.norm() > 1e-3 ? across.normalized() : direction.unitOrthogonal();
}

// Halfway to the nearest neighbour, or a little aside.
Place PlaceBeside(const Place& place, const std::vector<Place>& places, const Eigen::Vector3d& up)
{
  const Place* neighbor = nullptr;
  double least = 120 * degree;
  for (const Place& other : places)
  {
    const double angle = Angle(place.direction, other.direction);
    if (angle >= 10 * degree && angle < least)
    {
      least = angle;
      neighbor = &other;
    }
  }
  if (neighbor)
  {
    return { (place.direction + neighbor->direction).normalized(),
      std::sqrt(place.distance * neighbor->distance) };
  }
  const Eigen::AngleAxisd aside(15 * degree, UpFor(place.direction, up));
  return { aside * place.direction, place.distance };
}

double NearestAngle(const Place& place, const std::vector<Place>& chosen)
{
  double least = M_PI;
  for (const Place& other : chosen)
  {
    least = std::min(least, Angle(place.direction, other.direction));
  }
  return least;
}

}

std::vector<Camera> NovelCameras(
  const std::vector<Camera>& cameras, const Eigen::Vector3d& middle, int count)
{
  const std::vector<Place> places = PlacesAround(cameras, middle);
  const Eigen::Vector3d up = MeanUp(cameras);
  std::vector<Place> candidates;
  for (const Place& place : places)
  {
    candidates.push_back(PlaceBeside(place, places, up));
  }
  std::vector<Place> chosen;
  std::vector<Camera> novel;
  while (static_cast<int>(novel.size()) < count && !candidates.empty())
  {
    auto next = candidates.begin();
    if (!chosen.empty())
    {
      next = std::max_element(candidates.begin(), candidates.end(),
        [&chosen](const Place& a, const Place& b)
        { return NearestAngle(a, chosen) < NearestAngle(b, chosen); });
      if (NearestAngle(*next, chosen) < 5 * degree)
      {
        break;
      }
    }
    chosen.push_back(*next);
    novel.push_back(LookAt(
      cameras[0], middle + next->distance * next->direction, middle, UpFor(next->direction, up)));
  }
  return novel;
}

Eigen::Vector3d MedianPoint(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3 && !points.empty(); ++axis)
  {
    std::vector<double> values;
    for (const Eigen::Vector3d& point : points)
    {
      if (std::isfinite(point[axis]))
      {
        values.push_back(point[axis]);
      }
    }
    if (!values.empty())
    {
      const auto half = values.begin() + values.size() / 2;
      std::nth_element(values.begin(), half, values.end());
      middle[axis] = *half;
    }
  }
  return middle;
}

}
