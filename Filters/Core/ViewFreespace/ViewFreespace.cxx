// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/ViewFreespace.h"

#include <cmath>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr double EdgeOnCosine = 0.0872; // of 85 degrees

}

ViewFreespace::ViewFreespace(const DisparityMap& map, const CancellationFlag& stop)
  : Raster(map, stop)
  , Eye(map.camera.Center())
{
}

ViewFreespace::Sample ViewFreespace::At(const Vector3d& point) const
{
  const RasterMesh& mesh = this->Raster.Mesh();
  Sample sample;
  RasterMesh::Pixel pixel;
  if (!mesh.Project(point, pixel))
  {
    return sample;
  }
  const int found = this->Raster.Find(pixel);
  if (found < 0)
  {
    return sample;
  }
  const RasterMesh::Triangle& triangle = mesh.Triangles()[found];
  const double disparity = mesh.Disparity(triangle, pixel.x, pixel.y);
  sample.triangle = triangle.id;
  sample.value = 1.0 / disparity - pixel.depth;
  // The map's depth is 1 / disparity, and disparity is linear in the pixel.
  const auto row = [&mesh](int i) { return mesh.RasterFromWorld().row(i).head<3>().transpose(); };
  const Vector3d pixelX = (row(0) - pixel.x * row(2)) / pixel.depth;
  const Vector3d pixelY = (row(1) - pixel.y * row(2)) / pixel.depth;
  sample.gradient =
    -(triangle.slopeX * pixelX + triangle.slopeY * pixelY) / (disparity * disparity) - row(2);
  return sample;
}

bool ViewFreespace::IsFree(const Vector3d& point) const
{
  const RasterMesh& mesh = this->Raster.Mesh();
  RasterMesh::Pixel pixel;
  if (!mesh.Project(point, pixel))
  {
    return false;
  }
  const DisparityRaster::Cell& cell = this->Raster[this->Raster.CellAt(pixel.x, pixel.y)];
  if (cell.high * pixel.depth < 1.0)
  {
    return true;
  }
  if (cell.low * pixel.depth > 1.0)
  {
    return false;
  }
  const int found = this->Raster.Find(pixel);
  return found >= 0 &&
    mesh.Disparity(mesh.Triangles()[found], pixel.x, pixel.y) * pixel.depth < 1.0;
}

Vector3d ViewFreespace::WallNormal(const Vector3d& claimed, const Vector3d& beyond) const
{
  const RasterMesh& mesh = this->Raster.Mesh();
  RasterMesh::Pixel from, to;
  const bool inRaster = mesh.Project(claimed, from);
  const int start = inRaster ? this->Raster.Find(from) : -1;
  const Vector3d q = mesh.Raster(beyond);
  to = { q.x() / q.z(), q.y() / q.z(), q.z() };
  if (start >= 0 && to.depth > 0)
  {
    const RasterMesh::Walk walk = mesh.WalkTo(to.x, to.y, start);
    if (walk.border >= 0)
    {
      const auto& corner = mesh.Triangles()[walk.triangle].corner;
      const Vector2d& a = mesh.Corners()[corner[walk.border]].position;
      const Vector2d& b = mesh.Corners()[corner[(walk.border + 1) % 3]].position;
      // Triangles turn positively, so the line's positive side is the claimed one.
      const Vector3d line = a.homogeneous().cross(b.homogeneous());
      return (mesh.RasterFromWorld().leftCols<3>().transpose() * line).normalized();
    }
  }
  return (claimed - beyond).normalized();
}

void ViewFreespace::FreeIntervals(
  const Vector3d& first, const Vector3d& last, Intervals& intervals) const
{
  intervals.clear();
  this->VisitFreeIntervals(first, last,
    [&intervals](double begin, double end)
    {
      intervals.emplace_back(begin, end);
      return true;
    });
}

bool ViewFreespace::IsEdgeOn(const Vector3d& point, const Vector3d& normal) const
{
  const Vector3d ray = point - this->Eye;
  return std::abs(ray.dot(normal)) < EdgeOnCosine * ray.norm() * normal.norm();
}

}
