// SPDX-License-Identifier: BSD-3-Clause
#include "ViewSelection/ViewSelection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace freespace
{

std::vector<int> BestViews(const std::vector<Photograph>& views,
  const std::vector<VisibilityMap>& maps, const std::vector<Eigen::Vector3d>& samples,
  const Eigen::Vector3d& novelCenter, std::size_t count)
{
  std::vector<int> best(views.size());
  std::iota(best.begin(), best.end(), 0);
  if (views.size() <= count)
  {
    return best;
  }
  std::vector<double> scores(views.size(), 0.0);
  std::vector<double> weights(views.size());
  for (const Eigen::Vector3d& sample : samples)
  {
    const Eigen::Vector3d toNovel = (novelCenter - sample).normalized();
    double sum = 1e-12;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const Camera& camera = views[i].camera;
      const double confidence = maps[i].At(camera.Project(sample), camera.Depth(sample));
      const double chord = ((camera.Center() - sample).normalized() - toNovel).norm();
      weights[i] = confidence / std::pow(chord + 0.01, 2); // the nearest views weigh far more
      sum += weights[i];
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      scores[i] += weights[i] / sum;
    }
  }
  std::stable_sort(best.begin(), best.end(), [&](int a, int b) { return scores[a] > scores[b]; });
  best.resize(count);
  std::sort(best.begin(), best.end());
  return best;
}

ViewOrder OrderViews(const std::vector<Eigen::Vector3d>& centers,
  const std::vector<Eigen::Vector3d>& samples, const Eigen::Vector3d& novelCenter)
{
  const double margin = 0.02; // for what lies between the samples
  std::vector<double> chords;
  for (const Eigen::Vector3d& center : centers)
  {
    double least = 2;
    for (const Eigen::Vector3d& sample : samples)
    {
      const Eigen::Vector3d toNovel = (novelCenter - sample).normalized();
      least = std::min(least, ((center - sample).normalized() - toNovel).norm());
    }
    chords.push_back(least - margin);
  }
  ViewOrder order;
  order.views.resize(chords.size());
  std::iota(order.views.begin(), order.views.end(), 0);
  std::stable_sort(
    order.views.begin(), order.views.end(), [&](int a, int b) { return chords[a] < chords[b]; });
  for (const int view : order.views)
  {
    order.chords.push_back(static_cast<float>(chords[view]));
  }
  return order;
}

}
