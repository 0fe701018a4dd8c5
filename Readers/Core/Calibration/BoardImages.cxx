// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardImages.h"

#include "Files/PathChecks.h"
#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Files/FileNames.h"
#include "Images/DecodeImage.h"
#include "Images/ImageCodecs.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace freespace
{

namespace fs = std::filesystem;

cv::Mat ReadGrayImage(const std::string& file)
{
  cv::Mat gray = IsFile(file) ? DecodeImage(file, false) : cv::Mat();
  if (gray.empty())
  {
    throw Error("Cannot read the image " + file + ": it is missing or damaged.");
  }
  return gray;
}

void WriteBoardPictures(const BoardCalibration& calibration, const std::string& folder)
{
  std::error_code ignored;
  fs::create_directory(folder, ignored);
  std::vector<std::string> files;
  for (const BoardImage& image : calibration.images)
  {
    files.push_back(image.file);
  }
  const std::vector<std::string> names = DistinctFileNames(files);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const BoardImage& image = calibration.images[i];
    if (!image.used)
    {
      continue;
    }
    const fs::path target = fs::path(folder) / (names[i] + ".jpg");
    const cv::Mat pixels = DecodeImage(image.file, true);
    if (pixels.empty())
    {
      throw Error("Cannot read the image " + image.file + " again.");
    }
    AtomicOutput output(target.string());
    const std::vector<std::uint8_t> jpeg =
      EncodeImage(".jpg", DrawBoardCorners(pixels, image.corners));
    output.Write(jpeg.data(), jpeg.size());
    output.Commit();
  }
}

}
