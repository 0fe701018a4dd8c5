// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RandomMaps_h
#define freespace_RandomMaps_h

#include "Common/DisparityMap.h"

#include <random>

namespace freespace
{

/// A camera at `center` that looks at `target`, 100 x 80 pixels.
inline Camera LookingAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target)
{
  Camera camera;
  camera.width = 100;
  camera.height = 80;
  camera.K << 90, 0, 50, 0, 95, 40, 0, 0, 1;
  const Eigen::Vector3d z = (target - center).normalized();
  const Eigen::Vector3d x = z.unitOrthogonal();
  camera.R << x.transpose(), z.cross(x).transpose(), z.transpose();
  camera.t = -camera.R * center;
  return camera;
}

/// A map over a jittered grid of pixels with random depths, some of its cells left out. Image and
/// space agree, so that each image triangle is the image of its space triangle.
inline DisparityMap RandomMap(std::mt19937& random, int index)
{
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d direction(normal(random), normal(random), normal(random));
  DisparityMap map;
  map.name = "map" + std::to_string(index);
  map.camera = LookingAt(3.0 * direction.normalized(), 0.2 * Eigen::Vector3d::Random());
  const int n = 2 + static_cast<int>(5 * uniform(random));
  const double holes = uniform(random) < 0.5 ? 0.0 : 0.2;
  const double roughness = 1.2 * uniform(random);
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      const Eigen::Vector2d pixel(10 + (80.0 * i + 30 * (uniform(random) - 0.5)) / n,
        5 + (70.0 * j + 30 * (uniform(random) - 0.5)) / n);
      map.imagePoints.push_back(pixel);
      map.points.push_back(map.camera.Unproject(pixel, 3.0 + roughness * (uniform(random) - 0.5)));
      map.sourceView.push_back(index);
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if (uniform(random) >= holes)
      {
        map.triangles.push_back({ a, b, d });
        map.triangles.push_back({ a, d, c });
      }
    }
  }
  return map;
}

inline std::vector<DisparityMap> RandomMaps(unsigned int seed, int count)
{
  std::mt19937 random(seed);
  std::srand(seed); // Eigen's Random
  std::vector<DisparityMap> maps;
  for (int i = 0; i < count; ++i)
  {
    maps.push_back(RandomMap(random, i));
  }
  return maps;
}

}

#endif
