// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/ImagePyramids.h"

#include "Images/ImageMask.h"
#include "Images/UndistortedImage.h"

#include <opencv2/imgproc.hpp>

namespace freespace
{

namespace
{

// Reduces the noise and makes the interpolation between pixels accurate.
constexpr double Smoothing = 0.7; // sigma, pixels

constexpr int Levels = 2;

ImagePyramid MakePyramid(const cv::Mat& color)
{
  ImagePyramid pyramid;
  pyramid.color = color;
  cv::Mat grey, first;
  cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(first, CV_32F);
  cv::GaussianBlur(first, first, cv::Size(), Smoothing);
  pyramid.levels.push_back(first);
  for (int level = 1; level < Levels; ++level)
  {
    cv::Mat half;
    cv::resize(pyramid.levels.back(), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    pyramid.levels.push_back(half);
  }
  return pyramid;
}

}

ImagePyramids::ImagePyramids(const Scene& scene, std::size_t mostPixels)
  : Source(scene)
  , Cache(mostPixels)
{
}

std::shared_ptr<const ImagePyramid> ImagePyramids::Find(const CalibratedImage& image)
{
  return this->Cache.Find(
    image, [&] { return this->Read(image); },
    [](const ImagePyramid& pyramid) { return pyramid.color.total(); });
}

ImagePyramid ImagePyramids::Read(const CalibratedImage& image) const
{
  ImagePyramid pyramid =
    MakePyramid(Undistorted(this->Source.Pixels(image), image, cv::INTER_CUBIC));
  const std::string path = this->Source.MaskPath(image.file);
  const cv::Mat mask =
    path.empty() ? cv::Mat() : LoadMask(path, image.camera.width, image.camera.height);
  if (!mask.empty())
  {
    pyramid.mask = Undistorted(mask, image, cv::INTER_NEAREST);
  }
  return pyramid;
}

}
