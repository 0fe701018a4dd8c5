// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/DisparityImage.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// A triangle after it was cut at the near plane: 3 or 4 corners in the camera's frame.
struct CutTriangle
{
  std::array<Eigen::Vector3d, 4> corners;
  int count = 0;
};

CutTriangle CutAtNearPlane(const std::array<Eigen::Vector3d, 3>& triangle, double nearest)
{
  CutTriangle cut;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& a = triangle[i];
    const Eigen::Vector3d& b = triangle[(i + 1) % 3];
    if (a.z() >= nearest)
    {
      cut.corners[cut.count++] = a;
    }
    if ((a.z() >= nearest) != (b.z() >= nearest))
    {
      cut.corners[cut.count++] = a + (nearest - a.z()) / (b.z() - a.z()) * (b - a);
    }
  }
  return cut;
}

class Rasterizer
{
public:
  Rasterizer(const Camera& camera, DisparityImage& image)
    : Seen(camera)
    , Image(image)
  {
  }

  // The corners lie in a plane normal . x = offset, so that 1 / z = normal . K^-1 (u, v, 1) /
  // offset.
  void Draw(const std::array<Eigen::Vector3d, 3>& corners) const
  {
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double offset = normal.dot(corners[0]);
    const Eigen::RowVector3d plane = (normal.transpose() * this->InverseK) / offset;
    if (!plane.allFinite())
    {
      return; // without area, or seen edge-on
    }
    std::array<Eigen::Vector2d, 3> pixels;
    for (int i = 0; i < 3; ++i)
    {
      pixels[i] = (this->Seen.K * corners[i]).hnormalized();
    }
    const int firstRow = First(std::min({ pixels[0].y(), pixels[1].y(), pixels[2].y() }));
    const int lastRow =
      Last(std::max({ pixels[0].y(), pixels[1].y(), pixels[2].y() }), this->Image.height);
    for (int row = firstRow; row <= lastRow; ++row)
    {
      this->DrawRow(pixels, plane, row);
    }
  }

private:
  static int First(double coordinate)
  {
    return static_cast<int>(std::ceil(std::clamp(coordinate, 0.5, 1e9) - 0.5));
  }
  static int Last(double coordinate, int count)
  {
    return static_cast<int>(std::floor(std::clamp(coordinate, -1.0, count - 0.5) - 0.5));
  }

  // Where the three sides cut the line through the row's pixel centres.
  void DrawRow(
    const std::array<Eigen::Vector2d, 3>& pixels, const Eigen::RowVector3d& plane, int row) const
  {
    const double v = row + 0.5;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d& a = pixels[i];
      const Eigen::Vector2d& b = pixels[(i + 1) % 3];
      if (std::min(a.y(), b.y()) <= v && std::max(a.y(), b.y()) >= v)
      {
        const double span = b.y() - a.y();
        const double u = span == 0 ? a.x() : a.x() + (v - a.y()) / span * (b.x() - a.x());
        low = std::min({ low, u, span == 0 ? b.x() : u });
        high = std::max({ high, u, span == 0 ? b.x() : u });
      }
    }
    float* line = this->Image.values.data() + std::size_t(row) * this->Image.width;
    const int last = Last(high, this->Image.width);
    for (int column = First(low); column <= last; ++column)
    {
      const double disparity = plane[0] * (column + 0.5) + plane[1] * v + plane[2];
      line[column] = std::max(line[column], static_cast<float>(disparity));
    }
  }

  Camera Seen;
  Eigen::Matrix3d InverseK = this->Seen.K.inverse();
  DisparityImage& Image;
};

}

DisparityImage RenderDisparity(const TriangleMesh& mesh, const Camera& camera)
{
  DisparityImage image{ camera.width, camera.height,
    std::vector<float>(std::size_t(camera.width) * camera.height, 0.0f) };
  std::vector<Eigen::Vector3d> points(mesh.points.size());
  double farthest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = camera.FromWorld(mesh.points[i]);
    farthest = std::isfinite(points[i].z()) ? std::max(farthest, points[i].z()) : farthest;
  }
  const double nearest = 1e-4 * farthest;
  const Rasterizer rasterizer(camera, image);
  for (const std::array<int, 3>& triangle : mesh.triangles)
  {
    const std::array<Eigen::Vector3d, 3> corners = { points[triangle[0]], points[triangle[1]],
      points[triangle[2]] };
    const double depth = std::max({ corners[0].z(), corners[1].z(), corners[2].z() });
    if (!(depth > nearest) || !corners[0].allFinite() || !corners[1].allFinite() ||
      !corners[2].allFinite())
    {
      continue;
    }
    const CutTriangle cut = CutAtNearPlane(corners, nearest);
    for (int i = 2; i < cut.count; ++i)
    {
      rasterizer.Draw({ cut.corners[0], cut.corners[i - 1], cut.corners[i] });
    }
  }
  return image;
}

}
