// SPDX-License-Identifier: BSD-3-Clause
#include "Images/FeatureOverlay.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Images/ImageCodecs.h"
#include "Images/ImageFile.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

// Positions of the disparities on a colour scale of 0 .. 255, without its dark ends.
std::vector<std::uint8_t> ScaledDisparities(const View& view)
{
  std::vector<double> disparity;
  for (const Eigen::Vector3d& point : view.points)
  {
    disparity.push_back(1 / view.camera.Depth(point));
  }
  std::vector<double> sorted = disparity;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t tail = sorted.size() / 100;
  const double low = sorted.empty() ? 0 : sorted[tail];
  const double high = sorted.empty() ? 0 : sorted[sorted.size() - 1 - tail];
  std::vector<std::uint8_t> scaled;
  for (double value : disparity)
  {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    scaled.push_back(cv::saturate_cast<std::uint8_t>(25 + 205 * std::clamp(share, 0.0, 1.0)));
  }
  return scaled;
}

std::vector<cv::Scalar> FeatureColors(const View& view)
{
  const std::vector<std::uint8_t> scaled = ScaledDisparities(view);
  std::vector<cv::Scalar> colors;
  if (!scaled.empty())
  {
    cv::Mat table;
    cv::applyColorMap(cv::Mat(scaled, false).reshape(1, 1), table, cv::COLORMAP_TURBO);
    for (int i = 0; i < table.cols; ++i)
    {
      const cv::Vec3b& color = table.at<cv::Vec3b>(0, i);
      colors.emplace_back(color[0], color[1], color[2]);
    }
  }
  return colors;
}

}

void WriteFeatureOverlay(const View& view, const std::vector<std::vector<int>>& chains,
  const std::string& imagesFolder, const std::string& file)
{
  const std::string imageFile = (std::filesystem::path(imagesFolder) / view.imageFile).string();
  cv::Mat picture = LoadImage(imageFile, view.camera.width, view.camera.height);
  picture.convertTo(picture, -1, 0.4);
  const std::vector<cv::Scalar> colors = FeatureColors(view);
  constexpr int fraction = 4; // bits of a coordinate below the pixel
  const auto at = [&](int i)
  {
    const Eigen::Vector2d pixel =
      (view.imagePoints[i] - Eigen::Vector2d(0.5, 0.5)) * (1 << fraction);
    return cv::Point(cvRound(pixel.x()), cvRound(pixel.y()));
  };
  for (int i = 0; i < static_cast<int>(view.points.size()); ++i)
  {
    cv::line(picture, at(i), at(i), colors[i], 1, cv::LINE_8, fraction);
  }
  for (const std::vector<int>& chain : chains)
  {
    for (std::size_t k = 1; k < chain.size(); ++k)
    {
      cv::line(picture, at(chain[k - 1]), at(chain[k]), colors[chain[k]], 1, cv::LINE_AA, fraction);
    }
  }
  AtomicOutput output(file);
  const std::vector<std::uint8_t> png = EncodeImage(".png", picture);
  output.Write(png.data(), png.size());
  output.Commit();
}

}
