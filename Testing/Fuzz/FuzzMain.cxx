// SPDX-License-Identifier: BSD-3-Clause
// One door for the whole process, by the environment variable FREESPACE_DOOR.
//
//   libFuzzer (preset fuzz): FREESPACE_DOOR=scene FuzzCore CORPUS ...
//   without it, each input once: FREESPACE_DOOR=scene FuzzCore FOLDER_OR_FILE ...
#include "Doors.h"

#include "Common/Error.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace
{

freespace::Door FindDoor()
{
  const char* name = std::getenv("FREESPACE_DOOR");
  const std::string wanted = name ? name : "";
  std::string all;
  for (const freespace::Door& door : freespace::Doors())
  {
    if (wanted == door.name)
    {
      return door;
    }
    all += std::string(" ") + door.name;
  }
  std::cerr << "FREESPACE_DOOR is none of the doors here:" << all << "\n";
  std::exit(2);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const freespace::Door door = FindDoor();
  try
  {
    door.enter(std::string_view(reinterpret_cast<const char*>(data), size));
  }
  catch (const freespace::Error& error)
  {
    if (*error.what() == '\0')
    {
      std::abort(); // an error says what is wrong
    }
  }
  return 0;
}

#ifndef FREESPACE_LIBFUZZER

// The inputs of a file or folder, each once, in the order of their names.
int main(int argc, char* argv[])
{
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i)
  {
    if (fs::is_directory(argv[i]))
    {
      for (const fs::directory_entry& entry : fs::directory_iterator(argv[i]))
      {
        files.push_back(entry.path());
      }
    }
    else if (fs::exists(argv[i]))
    {
      files.emplace_back(argv[i]);
    }
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
  {
    std::ifstream stream(file, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(stream)), {});
    std::cout << file.string() << std::endl;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
  }
  std::cout << files.size() << " inputs" << std::endl;
  return files.empty() ? 1 : 0;
}

#endif
