// SPDX-License-Identifier: BSD-3-Clause
// The value of the union at a point, and its gradient.
#include "Freespace/FreespaceUnion.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// By how much a view does not contradict that a place is free: its height above the view's surface, or its depth below
// the layer in which the view votes against, whatever is more.
template <typename Winner>
Winner Unopposed(const ViewFreespace& view, const Vector3d& point, const Winner& own, double margin)
{
  if (own.value > 0)
  {
    return own;
  }
  const ViewFreespace::Sample nearer = view.At(Nearer(view, point, margin));
  const double below = -(1 + margin) * nearer.value;
  return nearer.triangle >= 0 && below > own.value ? Winner{ below, -nearer.gradient } : own;
}

}

// The greatest of: the k-th greatest of the claims, where k are enough; with a majority, the lesser of the j-th greatest
// claim and the (j + 1)-th least that views leave unopposed, so that j views are for it and at most j against.
FreespaceUnion::Winner FreespaceUnion::Voted(
  std::vector<Winner> claims, std::vector<Winner> unopposed) const
{
  const Winner none{ -HUGE_VAL, Vector3d::Zero() };
  const std::size_t k = static_cast<std::size_t>(this->Votes.enough);
  const std::size_t known = std::min(k, claims.size());
  const auto isGreater = [](const Winner& a, const Winner& b) { return a.value > b.value; };
  const auto isLess = [](const Winner& a, const Winner& b) { return a.value < b.value; };
  std::partial_sort(claims.begin(), claims.begin() + known, claims.end(), isGreater);
  Winner best = claims.size() < k ? none : claims[k - 1];
  if (this->Votes.isMajority)
  {
    const std::size_t opposed = std::min(known + 1, unopposed.size());
    std::partial_sort(unopposed.begin(), unopposed.begin() + opposed, unopposed.end(), isLess);
    for (std::size_t j = 0; j < known; ++j)
    {
      const Winner& lesser =
        j + 1 < opposed && unopposed[j + 1].value < claims[j].value ? unopposed[j + 1] : claims[j];
      best = lesser.value > best.value ? lesser : best;
    }
  }
  return best;
}

FreespaceUnion::Winner FreespaceUnion::Evaluate(const Vector3d& point) const
{
  const int plane = this->Hull().NearestPlane(point);
  if (plane < 0)
  {
    return { HUGE_VAL, Vector3d::Zero() };
  }
  const Winner hull = { this->Hull().Distance(plane, point), this->Hull().Normal(plane) };
  std::vector<Winner> claims, unopposed;
  const auto ask = [&](int index)
  {
    const ViewFreespace& view = *this->Views[index];
    const ViewFreespace::Sample sample = view.At(point);
    if (sample.triangle >= 0)
    {
      claims.push_back({ sample.value, sample.gradient });
      if (this->MarginOf(index) > 0)
      {
        unopposed.push_back(Unopposed(view, point, claims.back(), this->MarginOf(index)));
      }
    }
  };
  if (this->ClaimIndex().Contains(point))
  {
    const ViewOctree::Part part = this->ClaimIndex().At(point);
    std::for_each(part.begin, part.end, ask);
  }
  else
  {
    std::for_each(this->AllViews.begin(), this->AllViews.end(), ask);
  }
  const Winner seen = this->Voted(std::move(claims), std::move(unopposed));
  return seen.value > hull.value ? seen : hull;
}

double FreespaceUnion::Value(const Vector3d& point) const
{
  return this->Evaluate(point).value;
}

Vector3d FreespaceUnion::Gradient(const Vector3d& point) const
{
  return this->Evaluate(point).gradient;
}

}
