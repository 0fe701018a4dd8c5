// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NewFolder_h
#define freespace_NewFolder_h

#include <string>

namespace freespace
{

/// A folder for what a command makes. Where the command made the folder and nothing came into it, it is
/// taken away in the end.
class NewFolder
{
public:
  /// Makes the folder and those above it. Throws Error naming it when that fails, or something else has
  /// its name.
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
