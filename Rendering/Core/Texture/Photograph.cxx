// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/Photograph.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace freespace
{

Photograph Reduced(const Photograph& photograph, int longest)
{
  const int side = std::max(photograph.camera.width, photograph.camera.height);
  if (side <= longest)
  {
    return photograph;
  }
  Photograph result;
  result.name = photograph.name;
  Camera& camera = result.camera = photograph.camera;
  camera.width = std::max(1, int(std::int64_t(camera.width) * longest / side));
  camera.height = std::max(1, int(std::int64_t(camera.height) * longest / side));
  camera.K.row(0) *= double(camera.width) / photograph.camera.width;
  camera.K.row(1) *= double(camera.height) / photograph.camera.height;
  const cv::Mat from(photograph.camera.height, photograph.camera.width, CV_8UC3,
    const_cast<unsigned char*>(photograph.rgb.data()));
  result.rgb.resize(std::size_t(3) * camera.width * camera.height);
  cv::Mat to(camera.height, camera.width, CV_8UC3, result.rgb.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return result;
}

}
