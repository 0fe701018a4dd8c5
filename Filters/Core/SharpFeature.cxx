// SPDX-License-Identifier: BSD-3-Clause
#include "SharpFeature.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

/// A normal that leaves the plane of the two most different ones by so much (the sine) makes an edge
/// a corner.
constexpr double CornerSine = 0.5;

/// Normals that differ by more are of different surfaces: 53 degrees.
constexpr double SameSurfaceCosine = 0.6;

Vector3d NearestInBox(const Eigen::AlignedBox3d& box, const Vector3d& point)
{
  return point.cwiseMax(box.min()).cwiseMin(box.max());
}

// Moves a point along a line to the place in the box that is nearest to it. False: none is.
bool SlideIntoBox(const Vector3d& direction, const Eigen::AlignedBox3d& box, Vector3d& point)
{
  double low = -HUGE_VAL, high = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = box.min()[axis] - point[axis], b = box.max()[axis] - point[axis];
    if (std::abs(direction[axis]) < 1e-12)
    {
      if (a > 0 || b < 0)
      {
        return false;
      }
      continue;
    }
    low = std::max(low, std::min(a / direction[axis], b / direction[axis]));
    high = std::min(high, std::max(a / direction[axis], b / direction[axis]));
  }
  if (low > high)
  {
    return false;
  }
  point += std::clamp(0.0, low, high) * direction;
  return true;
}

}

bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Vector3d& position)
{
  double leastCosine = 1.0;
  Vector3d edge = Vector3d::Zero(), middle = Vector3d::Zero();
  for (const SurfacePlane& a : planes)
  {
    if (!(a.normal.squaredNorm() > 0.5))
    {
      return false;
    }
    middle += a.point / static_cast<double>(planes.size());
    for (const SurfacePlane& b : planes)
    {
      if (a.normal.dot(b.normal) < leastCosine)
      {
        leastCosine = a.normal.dot(b.normal);
        edge = a.normal.cross(b.normal);
      }
    }
  }
  if (leastCosine > sharpCosine || !(edge.norm() > 1e-3))
  {
    return false;
  }
  edge.normalize();
  const bool isCorner = std::any_of(planes.begin(), planes.end(),
    [&](const SurfacePlane& plane) { return std::abs(plane.normal.dot(edge)) > CornerSine; });
  // Least squares about the middle, in as many directions as the planes fix.
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const SurfacePlane& plane : planes)
  {
    square += plane.normal * plane.normal.transpose();
    right += plane.normal * plane.normal.dot(plane.point - middle);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(square);
  position = middle;
  for (int i = isCorner ? 0 : 1; i < 3; ++i)
  {
    const Vector3d direction = eigen.eigenvectors().col(i);
    position += direction * (direction.dot(right) / std::max(eigen.eigenvalues()[i], 1e-6));
  }
  if (isCorner || !SlideIntoBox(eigen.eigenvectors().col(0), box, position))
  {
    position = NearestInBox(box, position);
  }
  return true;
}

bool NormalsDiffer(const std::vector<SurfacePlane>& planes, double cosine)
{
  for (const SurfacePlane& a : planes)
  {
    for (const SurfacePlane& b : planes)
    {
      if (a.normal.dot(b.normal) < cosine)
      {
        return true;
      }
    }
  }
  return false;
}

void SmoothNormals(
  std::vector<SurfacePlane>& planes, const std::vector<SurfacePlane>& around, double radius)
{
  const double scale = -0.5 / (radius * radius);
  for (SurfacePlane& plane : planes)
  {
    Vector3d sum = Vector3d::Zero();
    for (const SurfacePlane& other : around)
    {
      const double likeness = plane.normal.dot(other.normal) - SameSurfaceCosine;
      if (likeness > 0)
      {
        sum +=
          likeness * std::exp(scale * (other.point - plane.point).squaredNorm()) * other.normal;
      }
    }
    if (sum.norm() > 0)
    {
      plane.normal = sum.normalized();
    }
  }
}

}
