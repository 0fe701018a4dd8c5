// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/FeatureThinning.h"

#include "Common/Error.h"
#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace freespace
{

namespace
{

// Features of one cell and depth.
struct Group
{
  std::size_t first = 0; // feature
  double disparity = 0;  // of the first
  int count = 0;
  double weights = 0;
  Eigen::Vector2d imagePoint = Eigen::Vector2d::Zero(); // weighted sums
  double sum = 0;

  void Add(const Eigen::Vector2d& pixel, double ofFeature, double deviation)
  {
    const double weight = 1 / (deviation * deviation);
    ++this->count;
    this->weights += weight;
    this->imagePoint += weight * pixel;
    this->sum += weight * ofFeature;
  }
};

class Thinner
{
public:
  Thinner(const View& view, const FeatureThinningOptions& options)
    : Given(view)
    , Options(options)
    , GroupOf(view.points.size(), -1)
  {
    std::vector<double> known;
    std::copy_if(view.deviations.begin(), view.deviations.end(), std::back_inserter(known),
      [](double deviation) { return deviation > 0; });
    this->Typical = MedianOr(std::move(known), 1.0);
  }

  View Thin()
  {
    for (std::size_t i = 0; i < this->Given.points.size(); ++i)
    {
      this->Add(i);
    }
    View thin;
    thin.name = this->Given.name;
    thin.imageFile = this->Given.imageFile;
    thin.camera = this->Given.camera;
    for (const Group& group : this->Groups)
    {
      const Eigen::Vector2d pixel = group.imagePoint / group.weights;
      thin.imagePoints.push_back(pixel);
      // One alone stays exactly where it is: views share the points of structure from motion.
      thin.points.push_back(group.count == 1
          ? this->Given.points[group.first]
          : thin.camera.Unproject(pixel, group.weights / group.sum));
      if (!this->Given.deviations.empty())
      {
        // Neighbours share most of their errors: as good as one of them.
        thin.deviations.push_back(std::sqrt(group.count / group.weights));
      }
    }
    this->JoinEdges(thin);
    return thin;
  }

private:
  void Add(std::size_t feature)
  {
    const double disparity = 1 / this->Given.camera.Depth(this->Given.points[feature]);
    const Eigen::Vector2d& pixel = this->Given.imagePoints[feature];
    if (!(disparity > 0) || !std::isfinite(disparity) || !pixel.allFinite())
    {
      return;
    }
    const std::size_t group = this->FindGroup(feature, disparity);
    this->GroupOf[feature] = static_cast<int>(group);
    const double known = this->Given.deviations.empty() ? 0 : this->Given.deviations[feature];
    this->Groups[group].Add(pixel, disparity, known > 0 ? known : this->Typical);
  }

  // The group of a feature, a new one where there is none.
  std::size_t FindGroup(std::size_t feature, double disparity)
  {
    const Eigen::Vector2d cell =
      (this->Given.imagePoints[feature] / this->Options.spacing).array().floor();
    std::vector<std::size_t>& groups = this->GroupsOfCell[{ cell.x(), cell.y() }];
    const auto known = std::find_if(groups.begin(), groups.end(),
      [&](std::size_t g)
      {
        const double first = this->Groups[g].disparity;
        return std::abs(first - disparity) <= this->Options.depthTolerance * first;
      });
    if (known != groups.end())
    {
      return *known;
    }
    groups.push_back(this->Groups.size());
    Group& group = this->Groups.emplace_back();
    group.first = feature;
    group.disparity = disparity;
    return groups.back();
  }

  void JoinEdges(View& thin) const
  {
    for (const auto& [a, b] : this->Given.edges)
    {
      const int first = this->GroupOf[static_cast<std::size_t>(a)];
      const int second = this->GroupOf[static_cast<std::size_t>(b)];
      if (first >= 0 && second >= 0 && first != second)
      {
        thin.edges.push_back({ std::min(first, second), std::max(first, second) });
      }
    }
    std::sort(thin.edges.begin(), thin.edges.end());
    thin.edges.erase(std::unique(thin.edges.begin(), thin.edges.end()), thin.edges.end());
  }

  const View& Given;
  const FeatureThinningOptions& Options;
  double Typical = 1;       // deviation, of features about which nothing is known
  std::vector<int> GroupOf; // per feature
  std::vector<Group> Groups;
  std::map<std::pair<double, double>, std::vector<std::size_t>> GroupsOfCell; // by column and row
};

}

void FeatureThinningOptions::Check() const
{
  if (!(this->spacing >= 0) || !std::isfinite(this->spacing))
  {
    throw Error("The spacing of thinned features must not be negative.");
  }
  if (!(this->depthTolerance > 0) || !std::isfinite(this->depthTolerance))
  {
    throw Error("The depth tolerance of thinned features must be positive.");
  }
}

View ThinFeatures(const View& view, const FeatureThinningOptions& options)
{
  options.Check();
  return options.spacing > 0 ? Thinner(view, options).Thin() : view;
}

}
