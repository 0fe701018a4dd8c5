// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WorkFolder.h"

#include "Common/ParseNumber.h"

#include <cerrno>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

constexpr char prefix[] = ".freespace-";

struct Registry
{
  std::mutex mutex, moving;
  std::set<fs::path> folders;
};

Registry& Folders()
{
  static auto* registry = new Registry; // lives until the process has ended
  return *registry;
}

// The process that a folder's name tells; none where it is another's folder.
std::optional<pid_t> OwnerOf(const fs::path& folder)
{
  const std::string name = folder.filename().string();
  const std::size_t begin = sizeof prefix - 1;
  if (name.compare(0, begin, prefix) != 0)
  {
    return {};
  }
  return ParseNumber<pid_t>(name.substr(begin, name.find('-', begin) - begin));
}

// A process of another machine is not seen here, but holds its lock.
void RemoveThoseOfTheDead(const fs::path& parent)
{
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, error))
  {
    const std::optional<pid_t> owner = OwnerOf(entry.path());
    if (!owner || *owner <= 0 || kill(*owner, 0) == 0 || errno != ESRCH ||
      !entry.is_directory(error) || entry.is_symlink(error))
    {
      continue;
    }
    if (const FileLock lock = FileLock::Try(entry.path()); lock.IsHeld())
    {
      fs::remove_all(entry.path(), error);
    }
  }
}

}

WorkFolder::WorkFolder(const fs::path& parent)
{
  RemoveThoseOfTheDead(parent);
  Registry& registry = Folders();
  const std::lock_guard<std::mutex> guard(registry.mutex);
  std::string pattern = (parent / (prefix + std::to_string(getpid()) + "-XXXXXX")).string();
  if (mkdtemp(pattern.data()))
  {
    this->Folder = pattern;
    this->Lock = FileLock::Try(this->Folder);
    registry.folders.insert(this->Folder);
  }
}

WorkFolder::~WorkFolder()
{
  Registry& registry = Folders();
  const std::lock_guard<std::mutex> guard(registry.mutex);
  std::error_code ignored;
  if (!this->Folder.empty())
  {
    fs::remove_all(this->Folder, ignored);
    registry.folders.erase(this->Folder);
  }
}

bool IsOwnWorkFolder(const fs::path& folder)
{
  return OwnerOf(folder) == getpid();
}

std::unique_lock<std::mutex> HoldWorkFolders()
{
  return std::unique_lock<std::mutex>(Folders().moving);
}

void RemoveWorkFolders()
{
  Registry& registry = Folders();
  const auto moving = HoldWorkFolders();
  const std::lock_guard<std::mutex> guard(registry.mutex);
  std::error_code ignored;
  for (const fs::path& folder : registry.folders)
  {
    fs::remove_all(folder, ignored);
  }
}

}
