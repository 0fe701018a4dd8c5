// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FileExtension_h
#define freespace_FileExtension_h

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace freespace
{

/// The extension of a file name, with its dot and in lower case: ".ply" of "Mesh.PLY".
inline std::string LowerCaseExtension(const std::string& fileName)
{
  std::string ending = std::filesystem::path(fileName).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Whether a file name ends in some text, case and all: "dino_par.txt" in "_par.txt".
inline bool EndsIn(const std::string& fileName, const std::string& ending)
{
  return fileName.size() >= ending.size() &&
    fileName.compare(fileName.size() - ending.size(), ending.size(), ending) == 0;
}

}

#endif
