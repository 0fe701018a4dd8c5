// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/SurfaceSamples.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace freespace
{

std::vector<SurfaceSample> SampleSurface(const TriangleMesh& mesh, int count)
{
  std::vector<double> areas(mesh.triangles.size());
  double sum = 0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d& corner = mesh.points[a];
    const double area = (mesh.points[b] - corner).cross(mesh.points[c] - corner).norm();
    sum += std::isfinite(area) ? area : 0;
    areas[i] = sum;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<SurfaceSample> samples;
  auto at = areas.begin();
  for (int i = 0; i < count && sum > 0; ++i)
  {
    at = std::find_if(
      at, areas.end(), [share = sum * (i + 0.5) / count](double area) { return area >= share; });
    const int triangle = static_cast<int>(at - areas.begin());
    const auto& [a, b, c] = mesh.triangles[triangle];
    double s = unit(random);
    double t = unit(random);
    if (s + t > 1)
    {
      s = 1 - s;
      t = 1 - t;
    }
    samples.push_back(
      { (1 - s - t) * mesh.points[a] + s * mesh.points[b] + t * mesh.points[c], triangle });
  }
  return samples;
}

}
