// SPDX-License-Identifier: BSD-3-Clause
#include "Export/CameraFrusta.h"

#include "Common/Median.h"
#include "Scene/CenterIndex.h"

namespace freespace
{

namespace
{

// The distance of each centre to the nearest one at another place, as far as that is among the nearest few.
std::vector<double> NearestDistances(const std::vector<Eigen::Vector3d>& centers)
{
  constexpr std::size_t neighbors = 8;
  const CenterIndex index(centers);
  std::vector<double> distances;
  for (const Eigen::Vector3d& center : centers)
  {
    for (int other : index.Nearest(center, neighbors))
    {
      const double distance = (centers[other] - center).norm();
      if (distance > 0)
      {
        distances.push_back(distance);
        break;
      }
    }
  }
  return distances;
}

}

TriangleMesh CameraFrusta(const std::vector<Camera>& cameras, double depth)
{
  TriangleMesh mesh;
  for (const Camera& camera : cameras)
  {
    const int first = static_cast<int>(mesh.points.size());
    const double width = camera.width, height = camera.height;
    mesh.points.push_back(camera.Center());
    for (const Eigen::Vector2d& pixel :
      { Eigen::Vector2d(0, 0), Eigen::Vector2d(width, 0), Eigen::Vector2d(width, height),
        Eigen::Vector2d(0, height), Eigen::Vector2d(width / 2, -height / 4) })
    {
      mesh.points.push_back(camera.Unproject(pixel, depth));
    }
    for (int i = 0; i < 4; ++i)
    {
      mesh.triangles.push_back({ first, first + 1 + (i + 1) % 4, first + 1 + i });
    }
    mesh.triangles.push_back({ first + 1, first + 2, first + 5 });
  }
  return mesh;
}

double FrustumDepth(const std::vector<Camera>& cameras)
{
  std::vector<Eigen::Vector3d> centers;
  for (const Camera& camera : cameras)
  {
    centers.push_back(camera.Center());
  }
  const std::vector<double> distances = NearestDistances(centers);
  return distances.empty() ? 1.0 : Median(distances) / 3;
}

}
