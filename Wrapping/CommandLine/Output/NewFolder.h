// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NewFolder_h
#define freespace_NewFolder_h

#include <string>

namespace freespace
{

/// A folder for the output of a command. If the command created the folder and it is empty in the end, it
/// is removed.
class NewFolder
{
public:
  /// Creates the folder and its parents. Throws Error naming it when that fails or a file has its name.
  explicit NewFolder(const std::string& folder);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

private:
  std::string Folder;
  std::string Uppermost; ///< of the folders that were made; empty where it was there
};

}

#endif
