// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureViews_h
#define freespace_FeatureViews_h

#include "Common/DisparityMap.h"
#include "Common/View.h"

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace freespace
{

/// A view of 1000 x 1000 pixels at the origin, without features.
inline View MakeView(double focalLength = 500)
{
  View view;
  view.name = "cluster";
  view.camera.K << focalLength, 0, 500, 0, focalLength, 500, 0, 0, 1;
  view.camera.width = view.camera.height = 1000;
  return view;
}

/// Adds what the view sees of a point.
inline void AddFeature(View& view, const Eigen::Vector3d& point)
{
  view.points.push_back(point);
  view.imagePoints.push_back(view.camera.Project(point));
}

inline void AddFeature(View& view, const Eigen::Vector2d& pixel, double depth)
{
  AddFeature(view, view.camera.Unproject(pixel, depth));
}

inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// The disparity of the map at a pixel; none outside its triangles.
inline std::optional<double> DisparityAt(const DisparityMap& map, const Eigen::Vector2d& pixel)
{
  for (const auto& triangle : map.triangles)
  {
    double weight[3], sum = 0, disparity = 0;
    bool inside = true;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d& a = map.imagePoints[triangle[(i + 1) % 3]];
      const Eigen::Vector2d& b = map.imagePoints[triangle[(i + 2) % 3]];
      weight[i] = Cross(a - pixel, b - pixel);
      inside = inside && weight[i] >= 0;
      sum += weight[i];
      disparity += weight[i] / map.camera.Depth(map.points[triangle[i]]);
    }
    if (inside)
    {
      return disparity / sum;
    }
  }
  return {};
}

/// Whether the point is nearer to the camera than the surface of the map.
inline bool IsFree(const DisparityMap& map, const Eigen::Vector3d& point)
{
  const std::optional<double> disparity = DisparityAt(map, map.camera.Project(point));
  return disparity && 1 / map.camera.Depth(point) > *disparity;
}

/// Views all round a cloud of points of which each recovers some; every third is a smooth surface,
/// so that few points stick out, every third a cloud, so that many do.
inline std::vector<View> RandomViews(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<View> views;
  for (int v = 0; v < 3; ++v)
  {
    View view = MakeView();
    view.camera.R = Eigen::AngleAxisd(
      0.4 * unit(random), Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized())
                      .matrix();
    view.camera.t = { 0, 0, 3 };
    const int count = 5 + static_cast<int>(random() % 60);
    for (int i = 0; i < count; ++i)
    {
      const double x = unit(random), y = unit(random), bump = std::cos(3 * x) * std::cos(3 * y);
      const double roughness = seed % 3 == 0 ? 1.0 : seed % 3 == 1 ? 0.1 : 0.01;
      AddFeature(view, Eigen::Vector3d(x, y, 0.3 * bump + roughness * unit(random)));
    }
    views.push_back(view);
  }
  return views;
}

/// Points over whole pixels: many coincide, lie on edges and on circles through others.
inline std::vector<View> LatticeViews(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> pixel(0, 8);
  // Of so few bits that each point projects exactly onto its pixel.
  std::uniform_int_distribution<long long> depth(1LL << 30, (1LL << 31) - 1);
  std::vector<View> views(2, MakeView(1));
  for (View& view : views)
  {
    view.camera.K << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    for (int i = 0; i < 40; ++i)
    {
      AddFeature(
        view, Eigen::Vector2d(pixel(random), pixel(random)), depth(random) / double(1 << 30));
    }
  }
  return views;
}

}

#endif
