// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/NearestOnTriangle.h"

#include <algorithm>
#include <limits>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

Vector3d NearestOnEdges(
  const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d* const corners[3] = { &a, &b, &c };
  double least = std::numeric_limits<double>::infinity();
  Vector3d weights(1, 0, 0);
  for (int i = 0; i < 3; ++i)
  {
    const Vector3d &from = *corners[i], along = *corners[(i + 1) % 3] - from;
    const double squared = along.squaredNorm();
    const double t = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
    const double distance = (from + t * along - point).squaredNorm();
    if (distance < least)
    {
      least = distance;
      weights.setZero();
      weights[i] = 1 - t;
      weights[(i + 1) % 3] = t;
    }
  }
  return weights;
}

}

// By the region of the plane that the point projects to (Ericson, "Real-Time Collision Detection",
// section 5.1.5).
Vector3d NearestOnTriangle(
  const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0)
  {
    return { 1, 0, 0 };
  }
  const Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3)
  {
    return { 0, 1, 0 };
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3)
  {
    const double v = d1 / (d1 - d3);
    return { 1 - v, v, 0 };
  }
  const Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6)
  {
    return { 0, 0, 1 };
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6)
  {
    const double w = d2 / (d2 - d6);
    return { 1 - w, 0, w };
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && (d4 - d3) + (d5 - d6) > 0)
  {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return { 0, 1 - w, w };
  }
  const double sum = va + vb + vc;
  const Vector3d inside(va / sum, vb / sum, vc / sum);
  constexpr double leastArea = 1e-12; // squared; below, the sum is mostly rounding
  return sum > leastArea * ab.squaredNorm() * ac.squaredNorm() ? inside
                                                               : NearestOnEdges(point, a, b, c);
}

}
