// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/FindSparseModel.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

struct Found
{
  fs::path folder;
  std::uintmax_t size = 0; // of the file of images
};

bool HasBoth(const fs::path& folder, const std::string& ending)
{
  std::error_code ignored;
  return fs::exists(folder / ("cameras" + ending), ignored) &&
    fs::exists(folder / ("images" + ending), ignored);
}

std::uintmax_t SizeOfImages(const fs::path& folder)
{
  std::error_code error;
  const std::uintmax_t size =
    fs::file_size(folder / (HasBoth(folder, ".bin") ? "images.bin" : "images.txt"), error);
  return error ? 0 : size;
}

void FindBelow(const fs::path& folder, int levels, std::vector<Found>& found)
{
  std::error_code error;
  std::vector<fs::path> below;
  for (const auto& entry : fs::directory_iterator(folder, error))
  {
    if (entry.is_directory(error))
    {
      below.push_back(entry.path());
    }
  }
  std::sort(below.begin(), below.end());
  for (const fs::path& path : below)
  {
    if (HasColmapModel(path.string()))
    {
      found.push_back({ path, SizeOfImages(path) });
    }
    else if (levels > 1)
    {
      FindBelow(path, levels - 1, found);
    }
  }
}

}

bool HasColmapModel(const std::string& folder)
{
  return HasBoth(folder, ".bin") || HasBoth(folder, ".txt");
}

std::string FindSparseModel(const std::string& path, std::string* told)
{
  constexpr int levels = 2;
  std::error_code ignored;
  if (told)
  {
    told->clear();
  }
  if (!fs::is_directory(path, ignored) || HasColmapModel(path) ||
    fs::exists(fs::path(path) / "scene.json", ignored) ||
    fs::exists(fs::path(path) / "bundle.out", ignored))
  {
    return path;
  }
  std::vector<Found> found;
  FindBelow(path, levels, found);
  if (found.empty())
  {
    return path;
  }
  const auto largest = std::max_element(
    found.begin(), found.end(), [](const Found& a, const Found& b) { return a.size < b.size; });
  std::string model = largest->folder.string();
  if (told)
  {
    *told = "the model is " + model +
      (found.size() > 1 ? ", the largest of " + std::to_string(found.size()) : "");
  }
  return model;
}

}
