// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/NovelCameras.h"

#include "Common/Median.h"
#include "Viewpoints/CommonUp.h"
#include "Viewpoints/FramePoints.h"
#include "Viewpoints/LookAt.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr double degree = M_PI / 180;

/// A way to look, and what is up in a picture that is taken so.
struct Gaze
{
  Eigen::Vector3d forward;
  Eigen::Vector3d up;
};

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d Axis(const View& view)
{
  return view.camera.R.row(2);
}

// Up is across the line of sight, and the camera's own where that goes straight up or down.
Eigen::Vector3d UpFor(
  const Eigen::Vector3d& forward, const Eigen::Vector3d& up, const Camera& camera)
{
  const Eigen::Vector3d across = up - up.dot(forward) * forward;
  return across.norm() > 0.1 ? across.normalized() : Eigen::Vector3d(-camera.R.row(1));
}

// Halfway to the nearest neighbour, but not far from where the view sees well.
Gaze GazeBeside(const View& view, const std::vector<View>& views, const Eigen::Vector3d& commonUp)
{
  const double most = 15 * degree;
  const Eigen::Vector3d forward = Axis(view);
  Eigen::Vector3d around = UpFor(forward, commonUp, view.camera);
  double least = 120 * degree;
  double aside = most;
  for (const View& other : views)
  {
    const double angle = Angle(forward, Axis(other));
    if (angle >= 10 * degree && angle < least)
    {
      least = angle;
      around = forward.cross(Axis(other)).normalized();
      aside = std::min(most, angle / 2);
    }
  }
  const Eigen::Vector3d turned = Eigen::AngleAxisd(aside, around) * forward;
  return { turned, UpFor(turned, commonUp, view.camera) };
}

double NearestAngle(const Gaze& gaze, const std::vector<Gaze>& chosen)
{
  double least = M_PI;
  for (const Gaze& other : chosen)
  {
    least = std::min(least, Angle(gaze.forward, other.forward));
  }
  return least;
}

// Its own features, and how much its picture holds of all: some of each view's stand for them.
double WorthOf(const View& view, const std::vector<View>& views)
{
  std::size_t held = 0;
  std::size_t all = 0;
  for (const View& other : views)
  {
    const std::size_t step = std::max<std::size_t>(1, other.points.size() / 100);
    for (std::size_t i = 0; i < other.points.size(); i += step, ++all)
    {
      const Eigen::Vector3d& point = other.points[i];
      held += view.camera.Depth(point) > 0 && view.camera.Sees(view.camera.Project(point));
    }
  }
  return all == 0 ? 0 : double(view.points.size()) * held / all;
}

// The first of those that see about the most: the clusters of a scene see much the same.
std::size_t BestView(const std::vector<View>& views)
{
  std::vector<double> worth;
  for (const View& view : views)
  {
    worth.push_back(WorthOf(view, views));
  }
  const double enough = 0.9 * *std::max_element(worth.begin(), worth.end());
  return std::find_if(worth.begin(), worth.end(), [=](double one) { return one >= enough; }) -
    worth.begin();
}

Camera Take(const Gaze& gaze, const std::vector<View>& views)
{
  std::vector<Eigen::Vector3d> points;
  for (const View& view : views)
  {
    if (Angle(gaze.forward, Axis(view)) < 60 * degree)
    {
      points.insert(points.end(), view.points.begin(), view.points.end());
    }
  }
  const Eigen::Vector3d middle = MedianPoint(points);
  return FramePoints(
    LookAt(views[0].camera, middle - gaze.forward, middle, gaze.up), points, Outliers::MayBeCutOff);
}

}

std::vector<Camera> NovelCameras(const std::vector<View>& all, int count)
{
  std::vector<View> views;
  std::vector<Camera> cameras;
  for (const View& view : all)
  {
    cameras.push_back(view.camera);
    if (!view.points.empty())
    {
      views.push_back(view);
    }
  }
  if (views.empty())
  {
    return {};
  }
  const Eigen::Vector3d up = CommonUp(cameras);
  std::vector<Gaze> candidates;
  for (const View& view : views)
  {
    candidates.push_back(GazeBeside(view, views, up));
  }
  std::vector<Gaze> chosen;
  std::vector<Camera> novel;
  std::size_t next = BestView(views);
  while (static_cast<int>(novel.size()) < count)
  {
    chosen.push_back(candidates[next]);
    novel.push_back(Take(candidates[next], views));
    const auto farthest = std::max_element(candidates.begin(), candidates.end(),
      [&chosen](const Gaze& a, const Gaze& b)
      { return NearestAngle(a, chosen) < NearestAngle(b, chosen); });
    if (NearestAngle(*farthest, chosen) < 5 * degree)
    {
      break;
    }
    next = farthest - candidates.begin();
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
      middle[axis] = Median(std::move(values));
    }
  }
  return middle;
}

}
