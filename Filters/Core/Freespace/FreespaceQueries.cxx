// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceQueries.h"

#include "Common/Octant.h"
#include "Freespace/Votes/VoteSweep.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

/// The greatest depth of the recursion over octants.
constexpr int DeepestHalving = 10;

// The part of a segment inside the closed hull; empty (begin > end) where the segment misses the
// hull.
std::pair<double, double> WithinHull(
  const FeatureHull& hull, const Vector3d& first, const Vector3d& last)
{
  double begin = 0.0, end = 1.0;
  for (int i = 0; i < hull.NumberOfPlanes(); ++i)
  {
    const double a = hull.Distance(i, first), b = hull.Distance(i, last);
    if (a > 0)
    {
      begin = std::max(begin, b > 0 ? 2.0 : a / (a - b));
    }
    else if (b > 0)
    {
      end = std::min(end, a / (a - b));
    }
  }
  return { begin, end };
}

// Splits a box into octants until they are decided. They have to be free only where they meet the
// ball.
class FreeBoxTest
{
public:
  FreeBoxTest(const FreespaceUnion& phi, const Vector3d& center, double radius)
    : Phi(phi)
    , Center(center)
    , Radius(radius)
  {
  }

  bool IsFree(const AlignedBox3d& box, const FieldScope& parent, int depth) const
  {
    if (box.squaredExteriorDistance(this->Center) > this->Radius * this->Radius)
    {
      return true;
    }
    FieldScope scope;
    BoxContent content = this->Phi.Classify(box, parent, scope);
    if (content == BoxContent::Mixed)
    {
      content = this->Phi.ClassifyFinely(box, scope);
    }
    if (content != BoxContent::Mixed)
    {
      return content == BoxContent::Free;
    }
    // One point of the ball in matter is enough.
    Vector3d nearest = this->Center.cwiseMax(box.min()).cwiseMin(box.max());
    nearest = std::isinf(this->Radius) ? box.center() : nearest;
    if (depth == DeepestHalving || !this->Phi.IsFree(nearest, scope))
    {
      return false;
    }
    for (int octant = 0; octant < 8; ++octant)
    {
      if (!this->IsFree(Octant(box, octant), scope, depth + 1))
      {
        return false;
      }
    }
    return true;
  }

private:
  const FreespaceUnion& Phi;
  const Vector3d Center;
  const double Radius;
};

}

bool IsPointFree(const FreespaceUnion& phi, const Vector3d& point)
{
  return point.allFinite() && phi.IsFree(point);
}

PointState StateOf(const FreespaceUnion& phi, const Vector3d& point)
{
  if (!point.allFinite())
  {
    return PointState::Unknown;
  }
  if (phi.IsSeenFree(point))
  {
    return PointState::Free;
  }
  return phi.IsFree(point) ? PointState::Unknown : PointState::Matter;
}

double FirstBlocked(const FreespaceUnion& phi, const Vector3d& first, const Vector3d& last)
{
  if (!first.allFinite() || !last.allFinite())
  {
    return 0.0;
  }
  const auto [enters, leaves] = WithinHull(phi.Hull(), first, last);
  if (phi.Hull().IsEmpty() || !(enters <= leaves))
  {
    return HUGE_VAL;
  }
  // Inside the hull only the views that are undecided around the segment begin or end to be free on
  // it.
  AlignedBox3d way(first + enters * (last - first));
  way.extend(first + leaves * (last - first));
  const FieldScope scope = phi.ScopeAround(way);
  const VoteRule& rule = phi.Rule();
  VoteSweep sweep(scope.votes);
  for (const int view : scope.views)
  {
    sweep.Add(view, phi.ViewAt(view), first, last, phi.MarginOf(view));
  }
  double blocked = enters;
  bool wasFree = rule.IsFree(scope.votes);
  while (sweep.Next())
  {
    const bool isFree = rule.IsFree(sweep.Votes());
    if (isFree && !wasFree && sweep.Place() > blocked)
    {
      return blocked;
    }
    if (wasFree && !isFree)
    {
      blocked = std::max(blocked, sweep.Place());
    }
    if (blocked > leaves)
    {
      return HUGE_VAL;
    }
    wasFree = isFree;
  }
  return !wasFree && (blocked < 1.0 || !phi.IsFree(last)) ? blocked : HUGE_VAL;
}

bool IsBoxFree(const FreespaceUnion& phi, const AlignedBox3d& box)
{
  if (!box.min().allFinite() || !box.max().allFinite() || box.isEmpty())
  {
    return false;
  }
  return FreeBoxTest(phi, box.center(), HUGE_VAL).IsFree(box, phi.ScopeAround(box), 0);
}

bool IsSphereFree(const FreespaceUnion& phi, const Vector3d& center, double radius)
{
  if (!center.allFinite() || !std::isfinite(radius) || radius < 0)
  {
    return false;
  }
  const Vector3d reach = Vector3d::Constant(radius);
  const AlignedBox3d box(center - reach, center + reach);
  return FreeBoxTest(phi, center, radius).IsFree(box, phi.ScopeAround(box), 0);
}

}
