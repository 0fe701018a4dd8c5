// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/RegionOfInterest.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

void RegionOptions::Check() const
{
  if (this->mode == Mode::Box &&
    !(this->box.min().allFinite() && this->box.max().allFinite() &&
      (this->box.sizes().array() > 0).all()))
  {
    throw Error(
      "The region is no box: it has finite bounds x0,x1,y0,y1,z0,z1, each lower than its upper.");
  }
  if (!(this->lossForSize > 0 && this->lossForSize < 1 && this->lossAround > 0 &&
        this->lossAround < 1))
  {
    throw Error("What a region may lose for its size must be above 0 and below 1.");
  }
  if (!(this->surroundings >= 0 && this->leastGain >= 1))
  {
    throw Error("A region's surroundings must be 0 or more and its least gain 1 or more.");
  }
}

namespace
{

// Number of features, evenly selected, and of other views that are evaluated for each.
constexpr std::size_t SampledFeatures = 40000;
constexpr std::size_t FewestOfView = 50;
constexpr std::size_t AskedViews = 64;

// Fewer are no sample of what is usual.
constexpr std::size_t FewFeatures = 100;

// What no other view confirms is seen from elsewhere in its own cluster, at least at such an angle.
constexpr double LeastAngle = M_PI / 180;

// A region holds so much of the weight; and grows by this share of its side to hold what the sample missed.
constexpr double LeastWeight = 0.5;
constexpr double Missed = 0.02;

struct Weighted
{
  Vector3d point;
  double weight;
};
using Sample = std::vector<Weighted>;

// The squared sine of the widest angle between a feature's own ray and that of another view that sees it.
double Triangulation(
  const Vector3d& point, const Camera& own, const std::vector<const Camera*>& others)
{
  const Vector3d ray = (point - own.Center()).normalized();
  double least = std::cos(LeastAngle);
  for (const Camera* other : others)
  {
    const double cosine = ray.dot((point - other->Center()).normalized());
    if (cosine < least && other->Depth(point) > 0 && other->Sees(other->Project(point)))
    {
      least = cosine;
    }
  }
  least = std::max(least, 0.0);
  return 1 - least * least;
}

Sample SampleOfView(const std::vector<ViewFeatures>& views, std::size_t index, std::size_t most)
{
  const ViewFeatures& view = views[index];
  std::vector<const Camera*> others;
  const std::size_t asked = std::min(AskedViews, views.size());
  for (std::size_t k = 1; k < asked; ++k)
  {
    others.push_back(&views[(index + k * views.size() / asked) % views.size()].camera);
  }
  const std::size_t count = std::min(most, view.points.size());
  Sample sample;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vector3d& point = view.points[k * view.points.size() / count];
    const double stands = static_cast<double>(view.points.size()) / count;
    sample.push_back({ point, stands * Triangulation(point, view.camera, others) });
  }
  return sample;
}

Sample TakeSample(
  const std::vector<ViewFeatures>& views, const ParallelFor& parallelFor, const Progress& progress)
{
  const std::size_t most = std::max(FewestOfView, SampledFeatures / views.size());
  std::vector<Sample> ofViews(views.size());
  ParallelForWithProgress(views.size(), parallelFor, progress,
    [&](std::size_t i, const CancellationFlag& stop)
    {
      ThrowIfCancelled(stop);
      ofViews[i] = SampleOfView(views, i, most);
    });
  Sample all;
  for (const Sample& sample : ofViews)
  {
    all.insert(all.end(), sample.begin(), sample.end());
  }
  return all;
}

AlignedBox3d BoundsOf(const Sample& sample)
{
  AlignedBox3d box;
  for (const Weighted& one : sample)
  {
    box.extend(one.point);
  }
  return box;
}

// Pairs of a value and its weight, by value.
using Values = std::vector<std::pair<double, double>>;

template <typename ValueOf>
Values Sorted(const Sample& sample, const ValueOf& valueOf)
{
  Values values;
  values.reserve(sample.size());
  for (const Weighted& one : sample)
  {
    values.emplace_back(valueOf(one.point), one.weight);
  }
  std::sort(values.begin(), values.end());
  return values;
}

template <typename IsKept>
void Keep(Sample& sample, const IsKept& isKept)
{
  sample.erase(std::remove_if(sample.begin(), sample.end(),
                 [&](const Weighted& one) { return !isKept(one.point); }),
    sample.end());
}

double Score(double weight, double squaredSize, double loss)
{
  return std::log(weight) - 0.5 * loss * std::log(squaredSize);
}

// Leaves out what is not in the best ball around the medians of the coordinates.
void KeepBall(Sample& sample, double loss)
{
  Vector3d middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Values values = Sorted(sample, [axis](const Vector3d& p) { return p[axis]; });
    double half = 0;
    for (const auto& value : values)
    {
      half += 0.5 * value.second;
    }
    auto at = values.begin();
    for (double sum = at->second; sum < half && at + 1 != values.end(); sum += at->second)
    {
      ++at;
    }
    middle[axis] = at->first;
  }
  const auto squared = [&middle](const Vector3d& p) { return (p - middle).squaredNorm(); };
  const Values values = Sorted(sample, squared);
  double all = 0;
  for (const auto& value : values)
  {
    all += value.second;
  }
  double best = -HUGE_VAL, radius = values.back().first, within = 0;
  for (const auto& [distance, weight] : values)
  {
    within += weight;
    if (within >= LeastWeight * all && distance > 0 && Score(within, distance, loss) > best)
    {
      best = Score(within, distance, loss);
      radius = distance;
    }
  }
  Keep(sample, [&](const Vector3d& p) { return squared(p) <= radius; });
}

// Places among sorted values where an interval may end: evenly, and closer towards both ends.
std::vector<std::size_t> Ends(std::size_t count)
{
  constexpr std::size_t even = 200;
  std::vector<std::size_t> ends = { 0, count - 1 };
  for (std::size_t i = 0; i < even; ++i)
  {
    ends.push_back(i * (count - 1) / (even - 1));
  }
  for (std::size_t i = 1; i < count / 2; i += i / 2 + 1)
  {
    ends.push_back(i);
    ends.push_back(count - 1 - i);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

// Leaves out what is not in the best interval of an axis.
void KeepInterval(Sample& sample, int axis, double loss)
{
  const Vector3d sizes = BoundsOf(sample).sizes();
  const double across = sizes.squaredNorm() - sizes[axis] * sizes[axis];
  const Values values = Sorted(sample, [axis](const Vector3d& p) { return p[axis]; });
  std::vector<double> below = { 0.0 };
  for (const auto& value : values)
  {
    below.push_back(below.back() + value.second);
  }
  double best = -HUGE_VAL, low = values.front().first, high = values.back().first;
  const std::vector<std::size_t> ends = Ends(values.size());
  for (std::size_t a : ends)
  {
    for (auto b = ends.rbegin(); b != ends.rend() && *b >= a; ++b)
    {
      const double weight = below[*b + 1] - below[a];
      if (weight < LeastWeight * below.back())
      {
        break;
      }
      const double side = values[*b].first - values[a].first;
      const double squaredSize = across + side * side;
      if (squaredSize > 0 && Score(weight, squaredSize, loss) > best)
      {
        best = Score(weight, squaredSize, loss);
        low = values[a].first;
        high = values[*b].first;
      }
    }
  }
  Keep(sample, [&](const Vector3d& p) { return p[axis] >= low && p[axis] <= high; });
}

void KeepBody(Sample& sample, double loss, const Progress& progress)
{
  constexpr int mostRounds = 20;
  std::size_t before = 0;
  for (int round = 0; round < mostRounds && sample.size() != before; ++round)
  {
    progress(static_cast<double>(round) / mostRounds);
    before = sample.size();
    KeepBall(sample, loss);
    for (int axis = 0; axis < 3; ++axis)
    {
      KeepInterval(sample, axis, loss);
    }
  }
}

AlignedBox3d Grown(const AlignedBox3d& box, double share)
{
  const Vector3d by = Vector3d::Constant(share * box.sizes().maxCoeff());
  return AlignedBox3d(box.min() - by, box.max() + by);
}

AlignedBox3d FeaturesIn(const std::vector<ViewFeatures>& views, const AlignedBox3d& box)
{
  AlignedBox3d bounds;
  for (const ViewFeatures& view : views)
  {
    for (const Vector3d& point : view.points)
    {
      if (box.contains(point))
      {
        bounds.extend(point);
      }
    }
  }
  return bounds;
}

AlignedBox3d FindBox(const std::vector<ViewFeatures>& views, const RegionOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  const Sample all = TakeSample(views, parallelFor, progress.Part(0.0, 0.5));
  Sample body = all;
  KeepBody(body, options.lossForSize, progress.Part(0.5, 0.8));
  const AlignedBox3d around = Grown(BoundsOf(body), options.surroundings);
  Sample kept = all;
  Keep(kept, [&](const Vector3d& p) { return around.contains(p); });
  for (Weighted& one : kept)
  {
    one.weight = 1;
  }
  KeepBody(kept, options.lossAround, progress.Part(0.8, 1.0));
  return FeaturesIn(views, Grown(BoundsOf(kept), Missed));
}

}

RegionOfInterest FindRegion(const std::vector<ViewFeatures>& views, const RegionOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  RegionOfInterest region;
  AlignedBox3d all;
  for (const ViewFeatures& view : views)
  {
    region.features += view.points.size();
    for (const Vector3d& point : view.points)
    {
      all.extend(point);
    }
  }
  region.box = all;
  if (options.mode == RegionOptions::Mode::Box)
  {
    region.box = FeaturesIn(views, options.box);
    if (region.features > 0 && region.box.isEmpty())
    {
      throw Error("The region holds none of the " + std::to_string(region.features) + " features.");
    }
  }
  else if (options.mode == RegionOptions::Mode::Automatic && region.features >= FewFeatures)
  {
    const AlignedBox3d found = FindBox(views, options, parallelFor, progress);
    const bool isWorth = all.diagonal().norm() >= options.leastGain * found.diagonal().norm();
    region.box = isWorth ? found : all;
  }
  for (const ViewFeatures& view : views)
  {
    region.beyond += std::count_if(view.points.begin(), view.points.end(),
      [&region](const Vector3d& point) { return !region.box.contains(point); });
  }
  progress(1.0);
  return region;
}

}
