// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WorkFolder_h
#define freespace_WorkFolder_h

#include "Files/FileLock.h"

#include <filesystem>
#include <mutex>
#include <string>

namespace freespace
{

/// A folder for what a run makes before it moves to its place: locked while it is in use, removed by the
/// destructor, by RemoveWorkFolders and, where its process was killed, by the next run.
class WorkFolder
{
public:
  /// Makes the folder `.freespace-PID-XXXXXX` in a folder, from which those of the dead are removed first.
  /// Path is empty where that fails.
  explicit WorkFolder(const std::filesystem::path& parent);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& Path() const { return this->Folder; }

private:
  std::filesystem::path Folder;
  FileLock Lock;
};

/// Whether a folder is a work folder of this process, by its name.
bool IsOwnWorkFolder(const std::filesystem::path& folder);

/// Held while files move to their places, which RemoveWorkFolders waits for.
std::unique_lock<std::mutex> HoldWorkFolders();

/// Removes all work folders of this process, which ends now.
void RemoveWorkFolders();

}

#endif
