// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/FeatureCloud.h"

#include "Disparity/PointHash.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace freespace
{

namespace
{

constexpr std::size_t pointsPerBox = 64;

// Points that occurred before, identified by their coordinates.
class PointSet
{
public:
  explicit PointSet(std::size_t mostPoints)
  {
    std::size_t size = 16;
    while (size < 2 * mostPoints)
    {
      size *= 2;
    }
    this->Slots.assign(size, empty);
  }

  // The index of the feature that has the point of the last one: its own where that is new.
  std::size_t Insert(const std::vector<FeatureCloud::Feature>& features)
  {
    const Eigen::Vector3d& point = features.back().point;
    std::size_t slot = PointHash()(point) & (this->Slots.size() - 1);
    while (this->Slots[slot] != empty)
    {
      if (features[this->Slots[slot]].point == point)
      {
        return this->Slots[slot];
      }
      slot = (slot + 1) & (this->Slots.size() - 1);
    }
    this->Slots[slot] = features.size() - 1;
    return features.size() - 1;
  }

private:
  static constexpr std::size_t empty = SIZE_MAX;

  std::vector<std::size_t> Slots; // indices of features
};

}

FeatureCloud::FeatureCloud(const std::vector<View>& views, const CancellationFlag& stop)
{
  const std::size_t own = this->TakeDistinct(views, stop);
  std::size_t begin = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    std::size_t end = begin;
    while (end < own && this->Features[end].sourceView == static_cast<int>(v))
    {
      ++end;
    }
    this->FirstBox.push_back(this->Boxes.size());
    this->Split(begin, end, stop);
    begin = end;
  }
  this->FirstBox.push_back(this->Boxes.size());
  this->Split(own, this->Features.size(), stop);
}

// Takes the distinct features of the views: first those of one view alone, by view, whose number it returns,
// then those that several views share.
std::size_t FeatureCloud::TakeDistinct(const std::vector<View>& views, const CancellationFlag& stop)
{
  std::size_t count = 0;
  for (const View& view : views)
  {
    count += view.points.size();
  }
  PointSet known(count);
  std::vector<Feature> distinct;
  std::vector<char> isShared;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    for (const Eigen::Vector3d& point : views[v].points)
    {
      ThrowIfCancelled(stop);
      if (!point.allFinite())
      {
        continue;
      }
      distinct.push_back({ point, static_cast<int>(v) });
      const std::size_t place = known.Insert(distinct);
      if (place < isShared.size())
      {
        isShared[place] |= distinct[place].sourceView != static_cast<int>(v);
        distinct.pop_back();
      }
      else
      {
        isShared.push_back(0);
      }
    }
  }
  for (const char taken : { 0, 1 })
  {
    for (std::size_t i = 0; i < distinct.size(); ++i)
    {
      if (isShared[i] == taken)
      {
        this->Features.push_back(distinct[i]);
      }
    }
  }
  return static_cast<std::size_t>(std::count(isShared.begin(), isShared.end(), 0));
}

// Halves the longest side of the points' box until few are left.
void FeatureCloud::Split(std::size_t begin, std::size_t end, const CancellationFlag& stop)
{
  ThrowIfCancelled(stop);
  if (begin == end)
  {
    return;
  }
  Eigen::AlignedBox3d bounds;
  for (std::size_t i = begin; i < end; ++i)
  {
    bounds.extend(this->Features[i].point);
  }
  if (end - begin <= pointsPerBox)
  {
    this->Boxes.push_back({ bounds.center(), bounds.sizes() / 2, begin, end });
    return;
  }
  Eigen::Index axis = 0;
  bounds.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = this->Features.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
    first + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(end),
    [axis](const Feature& a, const Feature& b) { return a.point[axis] < b.point[axis]; });
  this->Split(begin, middle, stop);
  this->Split(middle, end, stop);
}

FeatureCloud::Frustum::Frustum(const Camera& camera)
{
  Eigen::Matrix<double, 3, 4> project;
  project << camera.K * camera.R, camera.K * camera.t;
  const Eigen::Vector4d x = project.row(0), y = project.row(1), z = project.row(2);
  this->Planes = { z, x, camera.width * z - x, y, camera.height * z - y };
}

bool FeatureCloud::Frustum::MayContain(const Box& box) const
{
  return std::all_of(this->Planes.begin(), this->Planes.end(),
    [&](const Eigen::Vector4d& plane)
    {
      const double atCenter = plane.head<3>().dot(box.center) + plane.w();
      const double reach = plane.head<3>().cwiseAbs().dot(box.half);
      // Rounding must not cut off what lies on the border.
      const double slack = 1e-9 *
        (plane.head<3>().cwiseAbs().dot(box.center.cwiseAbs() + box.half) + std::abs(plane.w()));
      return atCenter + reach + slack >= 0;
    });
}

}
