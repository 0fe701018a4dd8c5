// SPDX-License-Identifier: BSD-3-Clause
#include "Output/NewFolder.h"

#include "Common/Error.h"

#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

NewFolder::NewFolder(const std::string& folder)
  : Folder((fs::path(folder) / "").parent_path().string()) // without a slash at its end
{
  std::error_code problem;
  for (fs::path path = this->Folder; !path.empty() && !fs::exists(path, problem);
       path = path.parent_path())
  {
    this->Uppermost = path.string();
  }
  problem.clear();
  fs::create_directories(this->Folder, problem);
  if (!problem && !fs::is_directory(this->Folder))
  {
    problem = std::make_error_code(std::errc::not_a_directory);
  }
  if (problem)
  {
    throw Error("Cannot make the folder " + folder + ": " + problem.message() + ".");
  }
}

NewFolder::~NewFolder()
{
  std::error_code problem;
  bool isLast = this->Uppermost.empty();
  for (fs::path path = this->Folder; !isLast && fs::is_empty(path, problem) && !problem;
       path = path.parent_path())
  {
    fs::remove(path, problem);
    isLast = path == this->Uppermost;
  }
}

}
