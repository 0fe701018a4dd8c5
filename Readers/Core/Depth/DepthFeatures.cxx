// SPDX-License-Identifier: BSD-3-Clause
#include "Depth/DepthFeatures.h"

#include "Common/Error.h"
#include "Images/LensDistortion.h"

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

// Depths along the camera's axis in the scene's unit, and where the pinhole camera sees the pixels.
class SceneDepths
{
public:
  SceneDepths(const CalibratedImage& image, const DepthMap& map, const DepthOptions& options)
    : Width(map.width)
    , Height(map.height)
    , Depths(map.depths.size())
    , Pixels(map.depths.size())
  {
    const Eigen::Vector2d scale(
      image.camera.width / double(map.width), image.camera.height / double(map.height));
    std::size_t i = 0;
    for (int row = 0; row < map.height; ++row)
    {
      for (int column = 0; column < map.width; ++column)
      {
        this->Pixels[i++] = scale.cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5));
      }
    }
    this->Pixels = UndistortPixels(image, this->Pixels);
    const Eigen::Matrix3d inverse = image.camera.K.inverse();
    for (i = 0; i < this->Depths.size(); ++i)
    {
      const double given = map.depths[i] * options.scale;
      const bool isUsed = given > 0 && std::isfinite(given) && this->Pixels[i].allFinite() &&
        given >= options.nearest && (options.farthest == 0 || given <= options.farthest);
      const Eigen::Vector3d ray = inverse * this->Pixels[i].homogeneous();
      this->Depths[i] = !isUsed ? 0 : options.isRange ? given / ray.norm() : given;
    }
  }

  std::size_t Index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(this->Width) +
      static_cast<std::size_t>(column);
  }

  double Depth(int column, int row) const { return this->Depths[this->Index(column, row)]; }

  const int Width;
  const int Height;
  std::vector<double> Depths; // 0: none
  std::vector<Eigen::Vector2d> Pixels;
};

// Selects pixels by dividing squares until the disparity interpolated from their corners is that of the map.
class PixelChoice
{
public:
  PixelChoice(const SceneDepths& depths, const DepthOptions& options)
    : Depths(depths)
    , Options(options)
    , IsChosen(depths.Depths.size(), 0)
  {
    const int step = options.largestBlock;
    for (int row = 0; row == 0 || row < depths.Height - 1; row += step)
    {
      for (int column = 0; column == 0 || column < depths.Width - 1; column += step)
      {
        this->Choose(column, row, std::min(column + step, depths.Width - 1),
          std::min(row + step, depths.Height - 1));
      }
    }
  }

  const std::vector<char>& Get() const { return this->IsChosen; }

private:
  // Between the corners, which belong to it.
  void Choose(int left, int top, int right, int bottom)
  {
    if ((right - left <= 1 && bottom - top <= 1) || this->IsFlat(left, top, right, bottom))
    {
      for (const int row : { top, bottom })
      {
        for (const int column : { left, right })
        {
          const std::size_t i = this->Depths.Index(column, row);
          this->IsChosen[i] = this->Depths.Depths[i] > 0;
        }
      }
      return;
    }
    const int middle = (left + right) / 2, center = (top + bottom) / 2;
    const bool isWide = right - left > 1, isHigh = bottom - top > 1;
    this->Choose(left, top, isWide ? middle : right, isHigh ? center : bottom);
    if (isWide)
    {
      this->Choose(middle, top, right, isHigh ? center : bottom);
    }
    if (isHigh)
    {
      this->Choose(left, center, isWide ? middle : right, bottom);
    }
    if (isWide && isHigh)
    {
      this->Choose(middle, center, right, bottom);
    }
  }

  // Whether the map agrees, within the tolerance, with the corners interpolated over either diagonal.
  bool IsFlat(int left, int top, int right, int bottom) const
  {
    const double z[] = { this->Depths.Depth(left, top), this->Depths.Depth(right, top),
      this->Depths.Depth(left, bottom), this->Depths.Depth(right, bottom) };
    if (!(std::min({ z[0], z[1], z[2], z[3] }) > 0))
    {
      return false;
    }
    for (int row = top; row <= bottom; ++row)
    {
      const double v = bottom > top ? (row - top) / double(bottom - top) : 0;
      for (int column = left; column <= right; ++column)
      {
        const double u = right > left ? (column - left) / double(right - left) : 0;
        const double depth = this->Depths.Depth(column, row);
        const double most = this->Options.tolerance * this->Options.DeviationAt(depth);
        const double falling = u > v ? (1 - u) / z[0] + (u - v) / z[1] + v / z[3]
                                     : (1 - v) / z[0] + (v - u) / z[2] + u / z[3];
        const double rising = u + v < 1 ? (1 - u - v) / z[0] + u / z[1] + v / z[2]
                                        : (u + v - 1) / z[3] + (1 - v) / z[1] + (1 - u) / z[2];
        if (!(depth > 0) || !(std::abs(1 / falling - depth) <= most) ||
          !(std::abs(1 / rising - depth) <= most))
        {
          return false;
        }
      }
    }
    return true;
  }

  const SceneDepths& Depths;
  const DepthOptions& Options;
  std::vector<char> IsChosen;
};

bool HaveSameShape(const Camera& camera, const DepthMap& map)
{
  constexpr double rounding = 1; // pixel of the smaller one
  const double scale = camera.width / double(map.width);
  return std::abs(scale * map.height - camera.height) <= rounding * std::max(1.0, scale);
}

}

void DepthOptions::Check() const
{
  if (!(this->scale > 0) || !std::isfinite(this->scale))
  {
    throw Error("The scale of depths must be positive.");
  }
  if (!(this->nearest >= 0) || !(this->farthest >= 0) ||
    (this->farthest > 0 && this->farthest < this->nearest))
  {
    throw Error("The nearest depth cannot be negative or beyond the farthest.");
  }
  if (!(this->deviation >= 0) || !(this->relativeDeviation >= 0) ||
    !(this->deviation + this->relativeDeviation > 0) ||
    !std::isfinite(this->deviation + this->relativeDeviation))
  {
    throw Error("The deviation of depths must be positive.");
  }
  if (!(this->tolerance >= 0) || !std::isfinite(this->tolerance) || this->largestBlock < 1 ||
    this->largestBlock > 1024)
  {
    throw Error("The tolerance of depths cannot be negative, and the largest block has from 1 to "
                "1024 pixels a side.");
  }
}

View FeaturesOfDepthMap(
  const CalibratedImage& image, const DepthMap& map, const DepthOptions& options)
{
  options.Check();
  if (map.width < 1 || map.height < 1 || !HaveSameShape(image.camera, map))
  {
    throw Error("The depth map of " + image.file + " has " + std::to_string(map.width) + " x " +
      std::to_string(map.height) + " pixels, and its camera " + std::to_string(image.camera.width) +
      " x " + std::to_string(image.camera.height) + ": another shape.");
  }
  const SceneDepths depths(image, map, options);
  const PixelChoice choice(depths, options);
  View view;
  view.name = view.imageFile = image.file;
  view.camera = image.camera;
  for (std::size_t i = 0; i < depths.Depths.size(); ++i)
  {
    if (choice.Get()[i])
    {
      const double depth = depths.Depths[i];
      view.points.push_back(view.camera.Unproject(depths.Pixels[i], depth));
      view.imagePoints.push_back(depths.Pixels[i]);
      view.deviations.push_back(options.DeviationAt(depth) / (depth * depth));
    }
  }
  return view;
}

std::size_t ImageOfDepthMap(const std::vector<CalibratedImage>& images, const std::string& file)
{
  const std::string name = ImageNameOfDepthMap(file);
  const auto alike = [&](const std::filesystem::path& image)
  { return image.filename() == name || image.stem() == name; };
  std::size_t found = images.size(), count = 0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    if (images[i].file == name)
    {
      return i;
    }
    if (alike(images[i].file))
    {
      found = i;
      ++count;
    }
  }
  if (count != 1)
  {
    throw Error("The depth map " + file +
      " belongs to no image that is known: " + (count == 0 ? "no" : std::to_string(count)) +
      (count > 1 ? " images are" : " image is") + " called " + name + ".");
  }
  return found;
}

}
