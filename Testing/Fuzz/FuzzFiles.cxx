// SPDX-License-Identifier: BSD-3-Clause
#include "Doors.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// Made once, in memory where the system has a folder for that, and removed at the end.
class ProcessFolder
{
public:
  ProcessFolder()
  {
    std::string name = (fs::is_directory("/dev/shm") ? std::string("/dev/shm")
                                                     : fs::temp_directory_path().string()) +
      "/freespace-fuzz-XXXXXX";
    if (!mkdtemp(name.data()))
    {
      throw std::runtime_error("There is no folder for the files of the fuzzer.");
    }
    this->Path = name;
  }
  ~ProcessFolder()
  {
    std::error_code ignored;
    fs::remove_all(this->Path, ignored);
  }
  ProcessFolder(const ProcessFolder&) = delete;
  ProcessFolder& operator=(const ProcessFolder&) = delete;

  fs::path Path;
};

}

std::string FuzzFolder()
{
  static const ProcessFolder folder;
  return folder.Path.string();
}

void PutFile(const std::string& name, std::string_view content)
{
  const fs::path path = fs::path(FuzzFolder()) / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
    .write(content.data(), static_cast<std::streamsize>(content.size()));
}

void RemoveFile(const std::string& name)
{
  fs::remove_all(fs::path(FuzzFolder()) / name);
}

std::vector<std::string_view> Parts(std::string_view bytes)
{
  constexpr std::string_view mark = "%%%%\n";
  std::vector<std::string_view> parts;
  for (std::size_t at = bytes.find(mark); at != std::string_view::npos; at = bytes.find(mark))
  {
    parts.push_back(bytes.substr(0, at));
    bytes.remove_prefix(at + mark.size());
  }
  parts.push_back(bytes);
  return parts;
}

}
