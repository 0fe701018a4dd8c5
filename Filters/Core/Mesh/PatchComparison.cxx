// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/PatchComparison.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// The least height of a triangle over its longest side, as a fraction of that side.
constexpr double LeastHeight = 1e-3;

// The least cosine of the angle between a triangle's normal and that of the plane.
constexpr double LeastUpCosine = 0.2;

Vector3d Normal(const std::array<Vector3d, 3>& t)
{
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

}

bool PatchComparison::HaveShape(const Triangles& triangles)
{
  return std::all_of(triangles.begin(), triangles.end(),
    [](const std::array<Vector3d, 3>& t)
    {
      const double longest = std::max(
        { (t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm() });
      return Normal(t).norm() > LeastHeight * longest;
    });
}

bool PatchComparison::Begin(const Triangles& before, const Triangles& after)
{
  Vector3d sum = Vector3d::Zero();
  for (const auto& t : before)
  {
    sum += Normal(t);
  }
  this->Up = sum.normalized();
  this->U = this->Up.unitOrthogonal();
  this->V = this->Up.cross(this->U);
  for (const Triangles* triangles : { &before, &after })
  {
    for (const auto& t : *triangles)
    {
      const Vector3d normal = Normal(t);
      if (!(normal.dot(this->Up) > LeastUpCosine * normal.norm()))
      {
        return false;
      }
    }
  }
  return true;
}

Vector3d PatchComparison::Local(const Vector3d& p) const
{
  return Vector3d(this->U.dot(p), this->V.dot(p), this->Up.dot(p));
}

bool PatchComparison::GoAroundOnce(const Triangles& fan, const Vector3d& center) const
{
  double turn = 0.0;
  const Vector2d c = this->Local(center).head<2>();
  for (const auto& t : fan)
  {
    const int at = t[0] == center ? 0 : t[1] == center ? 1 : 2;
    const Vector2d a = this->Local(t[(at + 1) % 3]).head<2>() - c;
    const Vector2d b = this->Local(t[(at + 2) % 3]).head<2>() - c;
    turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turn - 2 * M_PI) < 1e-6;
}

double PatchComparison::HeightAbove(const Triangles& triangles, const Vector3d& point) const
{
  const Vector3d p = this->Local(point);
  double best = -HUGE_VAL, height = HUGE_VAL;
  for (const auto& t : triangles)
  {
    const Vector3d a = this->Local(t[0]), b = this->Local(t[1]), c = this->Local(t[2]);
    const double area = Turn(a, b, c);
    const double wa = Turn(p, b, c) / area, wb = Turn(a, p, c) / area;
    const double inside = std::min({ wa, wb, 1 - wa - wb });
    if (inside > best)
    {
      best = inside;
      height = std::abs(p.z() - (wa * a.z() + wb * b.z() + (1 - wa - wb) * c.z()));
    }
  }
  return height;
}

double PatchComparison::GapAtCrossing(const Segment& s, const Segment& t) const
{
  const Vector3d a = this->Local(s.from), b = this->Local(s.to);
  const Vector3d c = this->Local(t.from), d = this->Local(t.to);
  const double ca = Turn(c, d, a), cb = Turn(c, d, b), ac = Turn(a, b, c), ad = Turn(a, b, d);
  if (!(ca * cb < 0 && ac * ad < 0))
  {
    return 0.0;
  }
  const double onS = ca / (ca - cb), onT = ac / (ac - ad);
  return std::abs(a.z() + onS * (b.z() - a.z()) - c.z() - onT * (d.z() - c.z()));
}

double PatchComparison::Turn(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}
