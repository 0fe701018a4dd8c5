// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/UnsizedModel.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Images/ImageSize.h"
#include "Images/LensDistortion.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_set>

namespace freespace
{

namespace
{

Eigen::Vector2d SmallestHalf(const std::vector<SparseObservation>& observations)
{
  Eigen::Vector2d half(1, 1);
  for (const SparseObservation& observation : observations)
  {
    half = half.cwiseMax(observation.pixel.cwiseAbs());
  }
  return half.cwiseMin(1e8).array().ceil(); // larger is refused with the camera
}

}

void UnsizedModel::Add(SparseImage image, Lens lens, Lens colmaps)
{
  this->Images.push_back({ std::move(image), std::move(lens), std::move(colmaps) });
}

void UnsizedModel::ReadObservation(TextSource& source, SparsePoint& point)
{
  const auto index = source.Number<std::uint64_t>("the index of an image");
  source.Number<std::uint64_t>("the index of a key");
  const double x = source.Number<double>("an observation's x");
  const double y = source.Number<double>("an observation's y");
  if (index >= this->Images.size())
  {
    source.Fail("there is no image " + std::to_string(index));
  }
  SparseImage& image = this->Images[static_cast<std::size_t>(index)].image;
  if (!image.name.empty())
  {
    point.track.push_back({ static_cast<std::uint32_t>(index + 1),
      static_cast<std::uint32_t>(image.observations.size()) });
    image.observations.push_back({ { x, this->Convention.up ? -y : y }, point.id });
  }
}

void UnsizedModel::ReadPoints(TextSource& source, std::uint64_t count)
{
  for (std::uint64_t i = 0; i < count; ++i)
  {
    SparsePoint point;
    point.id = i + 1;
    for (double& x : point.position)
    {
      x = source.Number<double>("a coordinate");
    }
    for (std::uint8_t& channel : point.color)
    {
      channel = source.Number<std::uint8_t>("a colour from 0 to 255");
    }
    const auto observations = source.Number<std::uint64_t>("a number of observations");
    for (std::uint64_t k = 0; k < observations; ++k)
    {
      this->ReadObservation(source, point);
    }
    if (const std::string fault = FaultOf(point); !fault.empty())
    {
      source.Fail(fault);
    }
    this->Points.push_back(std::move(point));
  }
}

// Of the observed points with COLMAP's lens, from the principal point.
std::vector<Eigen::Vector2d> UnsizedModel::Projections(const Placed& placed) const
{
  const CalibratedImage image =
    CalibratedImageOf(placed.image, { 0, placed.colmaps.model, 1, 1, placed.colmaps.parameters });
  std::vector<Eigen::Vector2d> pixels;
  for (const SparseObservation& observation : placed.image.observations)
  {
    pixels.push_back(
      image.camera.Project(this->Points[static_cast<std::size_t>(observation.point - 1)].position));
  }
  return DistortPixels(image, pixels);
}

bool UnsizedModel::AreCountedFromCorner() const
{
  const double least = this->Convention.firstCenter - 0.5; // of a coordinate in the image
  std::size_t count = 0, beyond = 0;
  if (this->Convention.origin)
  {
    return false;
  }
  for (const Placed& placed : this->Images)
  {
    for (const SparseObservation& observation : placed.image.observations)
    {
      if (!(observation.pixel.cwiseProduct(this->In).minCoeff() >= least))
      {
        return false;
      }
    }
  }
  for (const Placed& placed : this->Images)
  {
    for (const Eigen::Vector2d& pixel : this->Projections(placed))
    {
      ++count;
      beyond += pixel.cwiseProduct(this->In).minCoeff() < least;
    }
  }
  return count > 0 && 4 * beyond >= count;
}

Eigen::Vector2d UnsizedModel::HalfSize(
  const Placed& placed, bool fromCorner, const std::string& folder) const
{
  const auto size = ReadImageSize((std::filesystem::path(folder) / placed.image.name).string());
  const Eigen::Vector2d half =
    size ? Eigen::Vector2d((*size)[0] / 2.0, (*size)[1] / 2.0) : Eigen::Vector2d(0, 0);
  if (this->Convention.origin)
  {
    return size ? half : Eigen::Vector2d((2 * *this->Convention.origin).array().ceil() / 2);
  }
  if (!fromCorner)
  {
    return size ? half : SmallestHalf(placed.image.observations);
  }
  const std::vector<Eigen::Vector2d> projections = this->Projections(placed);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < projections.size(); ++i)
  {
    const Eigen::Vector2d offset = placed.image.observations[i].pixel - projections[i];
    if (offset.allFinite())
    {
      x.push_back(std::abs(offset.x()));
      y.push_back(std::abs(offset.y()));
    }
  }
  if (x.empty())
  {
    return size ? half : Eigen::Vector2d(1, 1);
  }
  const double corner = 0.5 - this->Convention.firstCenter;
  const Eigen::Vector2d middle(Median(std::move(x)) + corner, Median(std::move(y)) + corner);
  return size && (middle - half).cwiseAbs().maxCoeff() <= 1
    ? half
    : Eigen::Vector2d((2 * middle.cwiseMin(1e8)).array().round() / 2);
}

SparseModel UnsizedModel::Take(const std::string& file, const std::string& folder)
{
  const bool fromCorner = this->AreCountedFromCorner();
  SparseModel model;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    Placed& placed = this->Images[i];
    if (placed.image.name.empty())
    {
      continue;
    }
    const Eigen::Vector2d half = this->HalfSize(placed, fromCorner, folder);
    const Eigen::Vector2d middle = this->Convention.origin.value_or(half);
    const double corner = 0.5 - this->Convention.firstCenter;
    const Eigen::Vector2d origin = fromCorner
      ? Eigen::Vector2d(this->In.cwiseProduct((middle.array() - corner).matrix()))
      : Eigen::Vector2d(0, 0);
    for (SparseObservation& observation : placed.image.observations)
    {
      observation.pixel += middle - origin;
    }
    SparseCamera camera;
    Lens& lens = fromCorner ? placed.colmaps : placed.lens;
    camera.id = placed.image.id = placed.image.camera = static_cast<std::uint32_t>(i + 1);
    camera.model = lens.model;
    camera.width = static_cast<std::uint64_t>(std::max(0.0, 2 * half.x()));
    camera.height = static_cast<std::uint64_t>(std::max(0.0, 2 * half.y()));
    camera.parameters = std::move(lens.parameters);
    camera.parameters[FocalLengths(lens.model)] = middle.x();
    camera.parameters[FocalLengths(lens.model) + 1] = middle.y();
    std::string fault = FaultOf(camera);
    fault = fault.empty() ? FaultOf(placed.image) : fault;
    fault =
      names.insert(placed.image.name).second ? fault : "two images are called " + placed.image.name;
    if (!fault.empty())
    {
      throw Error(std::string("Cannot read ").append(file).append(": ").append(fault).append("."));
    }
    model.cameras.push_back(std::move(camera));
    model.images.push_back(std::move(placed.image));
  }
  model.points = std::move(this->Points);
  return model;
}

}
