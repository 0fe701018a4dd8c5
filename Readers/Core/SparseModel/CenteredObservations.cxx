// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/CenteredObservations.h"

#include "Common/Error.h"
#include "Images/ImageSize.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_set>

namespace freespace
{

namespace
{

std::array<std::uint64_t, 2> SmallestSize(const std::vector<SparseObservation>& observations)
{
  Eigen::Vector2d half(1, 1);
  for (const SparseObservation& observation : observations)
  {
    half = half.cwiseMax(observation.pixel.cwiseAbs());
  }
  half = half.cwiseMin(1e8); // larger is refused with the camera
  return { 2 * static_cast<std::uint64_t>(std::ceil(half.x())),
    2 * static_cast<std::uint64_t>(std::ceil(half.y())) };
}

std::array<std::uint64_t, 2> SizeOf(
  const std::filesystem::path& photograph, const std::vector<SparseObservation>& observations)
{
  if (const auto size = ReadImageSize(photograph.string()))
  {
    return { static_cast<std::uint64_t>((*size)[0]), static_cast<std::uint64_t>((*size)[1]) };
  }
  return SmallestSize(observations);
}

}

CenteredObservations::CenteredObservations(std::size_t images)
  : PerImage(images)
{
}

void CenteredObservations::Add(
  std::size_t image, const Eigen::Vector2d& fromMiddle, SparsePoint& point)
{
  std::vector<SparseObservation>& observations = this->PerImage[image];
  point.track.push_back(
    { static_cast<std::uint32_t>(image + 1), static_cast<std::uint32_t>(observations.size()) });
  observations.push_back({ fromMiddle, point.id });
}

void CenteredObservations::Finish(SparsePoint point)
{
  this->Model.points.push_back(std::move(point));
}

void CenteredObservations::Place(std::size_t index, SparseImage image, LensModel lens,
  std::vector<double> parameters, const std::string& folder)
{
  image.observations = std::move(this->PerImage[index]);
  const auto [width, height] =
    SizeOf(std::filesystem::path(folder) / image.name, image.observations);
  const Eigen::Vector2d middle(width / 2.0, height / 2.0);
  for (SparseObservation& observation : image.observations)
  {
    observation.pixel += middle;
  }
  const std::size_t principalPoint = FocalLengths(lens);
  parameters[principalPoint] = middle.x();
  parameters[principalPoint + 1] = middle.y();
  image.id = image.camera = static_cast<std::uint32_t>(index + 1);
  this->Model.cameras.push_back({ image.camera, lens, width, height, std::move(parameters) });
  this->Model.images.push_back(std::move(image));
}

SparseModel CenteredObservations::Take(const std::string& file)
{
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < this->Model.images.size(); ++i)
  {
    std::string fault = FaultOf(this->Model.cameras[i]);
    fault = fault.empty() ? FaultOf(this->Model.images[i]) : fault;
    if (!names.insert(this->Model.images[i].name).second)
    {
      fault = "two images are called " + this->Model.images[i].name;
    }
    if (!fault.empty())
    {
      throw Error("Cannot read " + file + ": " + fault + ".");
    }
  }
  return std::move(this->Model);
}

}
