// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/SharpFeature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

/// Minimum sine of the angle between a normal and the plane of the two most different ones at a corner.
constexpr double CornerSine = 0.5;

/// Normals that differ by more, 53 degrees, belong to different surfaces.
constexpr double SameSurfaceCosine = 0.6;

// The dual basis of the normals: along each direction only one plane is left, by a unit.
Eigen::Matrix3Xd DualBasis(const std::vector<Vector3d>& normals)
{
  Eigen::Matrix3Xd matrix(3, normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    matrix.col(i) = normals[i];
  }
  return matrix * (matrix.transpose() * matrix).inverse();
}

}

Vector3d SharpFeature::Up() const
{
  const Vector3d sum = DualBasis(this->normals).rowwise().sum();
  return sum.allFinite() ? Vector3d(sum.normalized()) : Vector3d(Vector3d::Zero());
}

bool SharpFeature::SlideInto(const Eigen::AlignedBox3d& box)
{
  double low = this->IsCorner() ? 0.0 : -HUGE_VAL, high = -low;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = box.min()[axis] - this->position[axis];
    const double b = box.max()[axis] - this->position[axis];
    const double slope = this->direction[axis];
    if (std::abs(slope) < 1e-12)
    {
      if (a > 0 || b < 0)
      {
        return false;
      }
      continue;
    }
    low = std::max(low, std::min(a / slope, b / slope));
    high = std::min(high, std::max(a / slope, b / slope));
  }
  if (low > high)
  {
    return false;
  }
  this->position += std::clamp(0.0, low, high) * this->direction;
  return true;
}

bool SharpFeature::IsConfirmed(
  double reach, const std::function<bool(const Vector3d& point)>& isFree) const
{
  const int planes = static_cast<int>(this->normals.size());
  const Eigen::Matrix3Xd dual = DualBasis(this->normals);
  if (!dual.allFinite())
  {
    return false;
  }
  bool free[8];
  for (int place = 0; place < 1 << planes; ++place)
  {
    Vector3d offset = Vector3d::Zero();
    for (int i = 0; i < planes; ++i)
    {
      offset += (place >> i & 1 ? reach : -reach) * dual.col(i);
    }
    free[place] = isFree(this->position + offset);
  }
  if (free[0] || !free[(1 << planes) - 1])
  {
    return false;
  }
  for (int i = 0; i < planes; ++i)
  {
    bool differs = false;
    for (int place = 0; place < 1 << planes; ++place)
    {
      differs = differs || free[place] != free[place ^ 1 << i];
    }
    if (!differs)
    {
      return false;
    }
  }
  return true;
}

bool FindSharpFeature(
  const std::vector<SurfacePlane>& planes, double sharpCosine, SharpFeature& feature)
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
        feature.normals = { a.normal, b.normal };
      }
    }
  }
  if (leastCosine > sharpCosine || !(edge.norm() > 1e-3))
  {
    return false;
  }
  edge.normalize();
  const auto third = std::max_element(planes.begin(), planes.end(),
    [&](const SurfacePlane& a, const SurfacePlane& b)
    { return std::abs(a.normal.dot(edge)) < std::abs(b.normal.dot(edge)); });
  const bool isCorner = std::abs(third->normal.dot(edge)) > CornerSine;
  if (isCorner)
  {
    feature.normals.push_back(third->normal);
  }
  // Least squares about the mean, in the directions that the planes constrain.
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const SurfacePlane& plane : planes)
  {
    square += plane.normal * plane.normal.transpose();
    right += plane.normal * plane.normal.dot(plane.point - middle);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(square);
  feature.position = middle;
  feature.direction = isCorner ? Vector3d::Zero() : Vector3d(eigen.eigenvectors().col(0));
  for (int i = isCorner ? 0 : 1; i < 3; ++i)
  {
    const Vector3d direction = eigen.eigenvectors().col(i);
    feature.position += direction * (direction.dot(right) / std::max(eigen.eigenvalues()[i], 1e-6));
  }
  return true;
}

bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Vector3d& position)
{
  SharpFeature feature;
  if (!FindSharpFeature(planes, sharpCosine, feature))
  {
    return false;
  }
  feature.SlideInto(box);
  position = feature.position.cwiseMax(box.min()).cwiseMin(box.max());
  return true;
}

bool FindCornerOnEdge(
  const SharpFeature& edge, const SurfacePlane& plane, double sharpCosine, SharpFeature& corner)
{
  const double slope = plane.normal.dot(edge.direction);
  const bool isApart = std::all_of(edge.normals.begin(), edge.normals.end(),
    [&](const Vector3d& normal) { return normal.dot(plane.normal) <= sharpCosine; });
  if (!isApart || std::abs(slope) <= CornerSine)
  {
    return false;
  }
  corner = edge;
  corner.position += plane.normal.dot(plane.point - edge.position) / slope * edge.direction;
  corner.direction = Vector3d::Zero();
  corner.normals.push_back(plane.normal);
  corner.isBorrowed = true;
  return true;
}

bool MoveToBoundary(Vector3d& point, const Vector3d& up, const Eigen::AlignedBox3d& box,
  const std::function<bool(const Vector3d& point)>& isFree)
{
  constexpr int steps = 16, halvings = 8;
  const bool wasFree = isFree(point);
  const Vector3d step = (wasFree ? -1.0 : 1.0) / steps * box.sizes().minCoeff() * up;
  const auto at = [&](double s) { return Vector3d(point + s * step); };
  double near = 0.0, far = 1.0;
  while (step.squaredNorm() > 0 && box.contains(at(far)) && isFree(at(far)) == wasFree)
  {
    near = far;
    far += 1.0;
  }
  if (!(step.squaredNorm() > 0) || !box.contains(at(far)))
  {
    return false;
  }
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = 0.5 * (near + far);
    (isFree(at(middle)) == wasFree ? near : far) = middle;
  }
  point = at(near);
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
