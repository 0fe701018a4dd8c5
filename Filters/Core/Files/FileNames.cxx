// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileNames.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t longest = 200; // bytes; file systems allow 255 with the ending

std::vector<std::string> Numbered(std::vector<std::string> names)
{
  std::set<std::string> taken;
  for (std::string& name : names)
  {
    const std::string first = name;
    for (int number = 2; !taken.insert(name).second; ++number)
    {
      name = first + "-" + std::to_string(number);
    }
  }
  return names;
}

// How many folders the paths have in common.
std::size_t CommonFolders(const std::vector<fs::path>& paths)
{
  std::size_t common = 0;
  for (bool isCommon = !paths.empty(); isCommon; common += isCommon)
  {
    const auto folder = [common](const fs::path& path)
    {
      auto at = path.begin();
      std::advance(at,
        std::min<std::ptrdiff_t>(
          static_cast<std::ptrdiff_t>(common), std::distance(path.begin(), path.end()) - 1));
      return *at;
    };
    isCommon = std::all_of(paths.begin(), paths.end(),
      [&](const fs::path& path)
      {
        const auto folders = std::distance(path.begin(), path.end()) - 1;
        return folders > static_cast<std::ptrdiff_t>(common) && folder(path) == folder(paths[0]);
      });
  }
  return common;
}

}

std::string FileNameOf(const std::string& name)
{
  std::string file = name.substr(0, longest);
  for (char& c : file)
  {
    const auto code = static_cast<unsigned char>(c);
    c = c == '/' || c == '\\' || code < 32 || code == 127 ? '_' : c;
  }
  if (file.empty() || file[0] == '.')
  {
    file.insert(0, "_");
  }
  return file;
}

std::vector<std::string> FileNamesOf(const std::vector<std::string>& names)
{
  std::vector<std::string> files;
  std::transform(names.begin(), names.end(), std::back_inserter(files), FileNameOf);
  return Numbered(std::move(files));
}

std::vector<std::string> DistinctFileNames(const std::vector<std::string>& paths)
{
  std::vector<fs::path> whole;
  std::set<std::string> different;
  for (const std::string& path : paths)
  {
    whole.push_back(fs::absolute(path).lexically_normal());
    different.insert(whole.back().stem().string());
  }
  const bool areDifferent = different.size() == paths.size();
  const std::size_t common = CommonFolders(whole);
  std::vector<std::string> names;
  for (const fs::path& path : whole)
  {
    std::string name = path.stem().string();
    if (!areDifferent)
    {
      fs::path folders;
      auto at = path.begin();
      std::advance(at, common);
      for (; at != std::prev(path.end()); ++at)
      {
        folders /= *at;
      }
      name = (folders / name).string();
    }
    names.push_back(FileNameOf(name));
  }
  return Numbered(std::move(names));
}

}
