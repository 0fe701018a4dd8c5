// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PathChecks_h
#define freespace_PathChecks_h

#include <filesystem>

namespace freespace
{

/// What is at a path whose name comes from a file. A name that no file can have, such as one that is too long,
/// is not there, where std::filesystem throws an error of its own.
inline bool IsThere(const std::filesystem::path& path)
{
  std::error_code none;
  return std::filesystem::exists(path, none);
}

inline bool IsFile(const std::filesystem::path& path)
{
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

inline bool IsFolder(const std::filesystem::path& path)
{
  std::error_code none;
  return std::filesystem::is_directory(path, none);
}

}

#endif
