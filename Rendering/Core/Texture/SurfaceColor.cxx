// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/SurfaceColor.h"

#include "Common/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace freespace
{

namespace
{

constexpr double LeastGrazingCosine = 0.05; // an image at grazing incidence is of no use

SurfaceColor::Color Interpolate(const Photograph& photograph, const Eigen::Vector2d& pixel)
{
  const int width = photograph.camera.width;
  const double x = std::clamp(pixel.x() - 0.5, 0.0, width - 1.0);
  const double y = std::clamp(pixel.y() - 0.5, 0.0, photograph.camera.height - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(0, width - 2));
  const int row = std::min(static_cast<int>(y), std::max(0, photograph.camera.height - 2));
  const double a = x - column;
  const double b = y - row;
  SurfaceColor::Color color;
  for (int channel = 0; channel < 3; ++channel)
  {
    const unsigned char* first = &photograph.rgb[3 * (std::size_t(row) * width + column) + channel];
    const unsigned char* second = first + std::size_t(3) * width;
    color[channel] =
      (1 - b) * ((1 - a) * first[0] + a * first[3]) + b * ((1 - a) * second[0] + a * second[3]);
  }
  return color;
}

}

void SurfaceColorOptions::Check() const
{
  this->visibility.Check();
  if (!(this->sharpness >= 0 && this->sharpness <= 100))
  {
    throw Error("The sharpness of a surface's colour must be from 0 to 100.");
  }
}

SurfaceColor::SurfaceColor(const TriangleMesh& mesh, std::vector<Photograph> photographs,
  const SurfaceColorOptions& options, const ParallelFor& parallelFor)
  : Photographs(std::move(photographs))
  , Maps(this->Photographs.size())
  , Levels(this->Photographs.size(), Color::Ones())
  , Sharpness(options.sharpness)
{
  options.Check();
  for (const Photograph& photograph : this->Photographs)
  {
    if (photograph.camera.width < 2 || photograph.camera.height < 2)
    {
      throw Error("Image '" + photograph.name + "' has less than 2 x 2 pixels.");
    }
  }
  parallelFor(this->Maps.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Maps[i] = MakeVisibilityMap(mesh, this->Photographs[i].camera, options.visibility);
        FillMasked(this->Maps[i], this->Photographs[i]);
      }
    });
  if (options.level)
  {
    this->Level(mesh);
  }
}

double SurfaceColor::Weight(std::size_t photograph, const Eigen::Vector3d& point,
  const Eigen::Vector3d& normal, Eigen::Vector2d& pixel) const
{
  const Camera& camera = this->Photographs[photograph].camera;
  const double depth = camera.Depth(point);
  const double cosine = normal.dot((camera.Center() - point).normalized());
  if (!(depth > 0) || !(cosine > LeastGrazingCosine))
  {
    return 0;
  }
  pixel = camera.Project(point);
  const double confidence = this->Maps[photograph].At(pixel, depth);
  if (!(confidence > 0))
  {
    return 0;
  }
  const double pixels = camera.FocalLength() / depth;
  return confidence * std::pow(cosine * pixels * std::sqrt(confidence), this->Sharpness);
}

std::optional<SurfaceColor::Color> SurfaceColor::At(
  const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  Color sum = Color::Zero();
  double weights = 0;
  Eigen::Vector2d pixel;
  for (std::size_t i = 0; i < this->Photographs.size(); ++i)
  {
    const double weight = this->Weight(i, point, normal, pixel);
    if (weight > 0)
    {
      sum += weight * Interpolate(this->Photographs[i], pixel).cwiseProduct(this->Levels[i]);
      weights += weight;
    }
  }
  if (!(weights > 0))
  {
    return std::nullopt;
  }
  return (sum / weights).cwiseMax(0).cwiseMin(255).eval();
}

double SurfaceColor::PixelSize(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  double best = std::numeric_limits<double>::infinity();
  Eigen::Vector2d pixel;
  for (std::size_t i = 0; i < this->Photographs.size(); ++i)
  {
    if (this->Weight(i, point, normal, pixel) > 0)
    {
      const Camera& camera = this->Photographs[i].camera;
      best = std::min(best, camera.Depth(point) / camera.FocalLength());
    }
  }
  return best;
}

// The gains g for which the logarithms of g_i c_i and g_j c_j agree best in the least squares, over points
// that the images i and j both see; a weak prior of 1 fixes what no pair determines.
void SurfaceColor::Level(const TriangleMesh& mesh)
{
  const std::size_t count = this->Photographs.size();
  const std::size_t samples = 4000;
  const double darkest = 20; // of 255: below, noise decides; above 250 colours are cut off
  std::vector<Eigen::MatrixXd> systems(
    3, 1e-3 * samples / std::max<std::size_t>(1, count) * Eigen::MatrixXd::Identity(count, count));
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / samples);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step)
  {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d point = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    const Eigen::Vector3d normal =
      (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
    std::vector<std::pair<std::size_t, Color>> seen;
    Eigen::Vector2d pixel;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->Weight(i, point, normal, pixel) > 0 &&
        this->Maps[i].At(pixel, this->Photographs[i].camera.Depth(point)) > 0.9)
      {
        seen.emplace_back(i, Interpolate(this->Photographs[i], pixel));
      }
    }
    for (std::size_t p = 0; p < seen.size(); ++p)
    {
      for (std::size_t q = p + 1; q < seen.size(); ++q)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          const double first = seen[p].second[channel];
          const double second = seen[q].second[channel];
          if (std::min(first, second) < darkest || std::max(first, second) > 250)
          {
            continue;
          }
          const std::size_t i = seen[p].first;
          const std::size_t j = seen[q].first;
          // Pairs that differ much are of two surfaces or a reflection: they have little weight.
          const double difference = std::log(second / first);
          const double weight = 1 / (1 + 25 * difference * difference);
          systems[channel](i, i) += weight;
          systems[channel](j, j) += weight;
          systems[channel](i, j) -= weight;
          systems[channel](j, i) -= weight;
          right(i, channel) += weight * difference;
          right(j, channel) -= weight * difference;
        }
      }
    }
  }
  for (int channel = 0; channel < 3 && count > 0; ++channel)
  {
    const Eigen::VectorXd logarithms = systems[channel].ldlt().solve(right.col(channel));
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Levels[i][channel] = std::exp(std::clamp(logarithms[i], -1.0, 1.0));
    }
  }
}

}
