// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/PartnerViews.h"

#include "Common/DisparityMap.h"
#include "Common/Error.h"
#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freespace
{

namespace
{

using Place = Eigen::Matrix<double, 6, 1>;

// Where a camera is and what it looks at: the median of the features, coordinate by coordinate.
Place PlaceOf(const View& view)
{
  Place place;
  place.head<3>() = view.camera.Center();
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> values;
    for (const Eigen::Vector3d& point : view.points)
    {
      if (point.allFinite())
      {
        values.push_back(point[axis]);
      }
    }
    place[3 + axis] = MedianOr(std::move(values), place[axis]);
  }
  return place;
}

// Ranks among the other views: the first half one after the other, then as a geometric series up to the last.
std::vector<std::size_t> RanksOf(std::size_t others, std::size_t most)
{
  std::vector<std::size_t> ranks(std::min(others, most));
  std::iota(ranks.begin(), ranks.end(), 0);
  if (others > most)
  {
    const std::size_t next = (most + 1) / 2, spread = most - next;
    const double ratio =
      static_cast<double>(others) / static_cast<double>(std::max<std::size_t>(next, 1));
    for (std::size_t k = 0; k < spread; ++k)
    {
      const double rank = static_cast<double>(next) *
          std::pow(ratio, static_cast<double>(k + 1) / static_cast<double>(spread)) -
        1;
      // Never one twice: ranks grow by one at least.
      const std::size_t least = next + k;
      ranks[next + k] =
        std::min(others - spread + k, std::max(least, static_cast<std::size_t>(rank)));
      if (k > 0)
      {
        ranks[next + k] = std::max(ranks[next + k], ranks[next + k - 1] + 1);
      }
    }
  }
  return ranks;
}

}

void PartnerViewsOptions::Check() const
{
  if (this->most < 0)
  {
    throw Error("The number of views that a view is compared with must not be negative.");
  }
}

template <typename AnyView>
std::vector<std::vector<int>> PartnerViews(
  const std::vector<AnyView>& views, const PartnerViewsOptions& options)
{
  options.Check();
  const std::size_t others = views.empty() ? 0 : views.size() - 1;
  const bool isLimited = options.most > 0 && others > static_cast<std::size_t>(options.most);
  std::vector<Place> places(isLimited ? views.size() : 0);
  std::transform(views.begin(), views.begin() + static_cast<std::ptrdiff_t>(places.size()),
    places.begin(), PlaceOf);
  const std::vector<std::size_t> ranks =
    RanksOf(others, isLimited ? static_cast<std::size_t>(options.most) : others);
  std::vector<std::vector<int>> partners(views.size());
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    std::vector<std::pair<double, int>> near;
    for (std::size_t other = 0; other < views.size(); ++other)
    {
      if (other != v)
      {
        near.emplace_back(
          isLimited ? (places[other] - places[v]).squaredNorm() : 0.0, static_cast<int>(other));
      }
    }
    std::sort(near.begin(), near.end());
    for (const std::size_t rank : ranks)
    {
      partners[v].push_back(near[rank].second);
    }
    std::sort(partners[v].begin(), partners[v].end());
  }
  return partners;
}

template std::vector<std::vector<int>> PartnerViews(
  const std::vector<View>& views, const PartnerViewsOptions& options);
template std::vector<std::vector<int>> PartnerViews(
  const std::vector<DisparityMap>& views, const PartnerViewsOptions& options);

}
