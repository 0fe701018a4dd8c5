// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharedData_h
#define freespace_SharedData_h

#include <cstdlib>
#include <filesystem>
#include <string>

namespace freespace
{

/// A file or folder of the data that is too large for the source tree, below `data` in the folder
/// named by the environment variable FREESPACE_SHARED or else by the CMake variable of that name.
/// Empty where it is absent: the test is then to be skipped.
inline std::string SharedData(const std::string& name)
{
  const char* variable = std::getenv("FREESPACE_SHARED");
  const std::filesystem::path folder = variable ? variable : FREESPACE_SHARED;
  return std::filesystem::exists(folder / "data" / name) ? (folder / "data" / name).string() : "";
}

}

#endif
