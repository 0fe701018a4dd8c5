// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PhotographStore.h"

#include "Images/UndistortedImage.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

// Against the noise, and so that interpolation between pixels is accurate.
constexpr double Smoothing = 0.7; // sigma, pixels

constexpr int Levels = 2;

std::shared_ptr<const Photograph> MakePhotograph(const cv::Mat& color)
{
  auto photograph = std::make_shared<Photograph>();
  photograph->color = color;
  cv::Mat grey, first;
  cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(first, CV_32F);
  cv::GaussianBlur(first, first, cv::Size(), Smoothing);
  photograph->levels.push_back(first);
  for (int level = 1; level < Levels; ++level)
  {
    cv::Mat half;
    cv::resize(photograph->levels.back(), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    photograph->levels.push_back(half);
  }
  return photograph;
}

bool HaveSameLens(const CalibratedImage& a, const CalibratedImage& b)
{
  return a.camera.K == b.camera.K && a.distortion == b.distortion;
}

}

PhotographStore::PhotographStore(const std::string& folder, std::size_t mostPixels)
  : Folder(folder)
  , MostPixels(mostPixels)
{
}

std::shared_ptr<const Photograph> PhotographStore::Find(const CalibratedImage& image)
{
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::shared_ptr<Entry>& known = this->Entries[image.file];
    if (!known)
    {
      known = std::make_shared<Entry>();
    }
    entry = known;
  }
  const std::lock_guard<std::mutex> busy(entry->mutex);
  if (!entry->photograph || !HaveSameLens(entry->image, image))
  {
    const std::string file = (std::filesystem::path(this->Folder) / image.file).string();
    entry->photograph = MakePhotograph(ReadUndistortedImage(file, image));
    entry->image = image;
  }
  const auto photograph = entry->photograph;
  this->Keep(image.file, entry, photograph->levels.front().total());
  return photograph;
}

// Lets go of what was not asked for longest. Who holds an image's photograph may go on with it.
void PhotographStore::Keep(
  const std::string& file, const std::shared_ptr<Entry>& entry, std::size_t pixels)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto used = std::find_if(this->LastUsed.begin(), this->LastUsed.end(),
    [&](const auto& use) { return use.first == file; });
  if (used != this->LastUsed.end())
  {
    this->Pixels -= used->second;
    this->LastUsed.erase(used);
  }
  this->Entries[file] = entry;
  this->LastUsed.emplace_back(file, pixels);
  this->Pixels += pixels;
  while (this->Pixels > this->MostPixels && this->LastUsed.size() > 1)
  {
    this->Entries.erase(this->LastUsed.front().first);
    this->Pixels -= this->LastUsed.front().second;
    this->LastUsed.pop_front();
  }
}

}
