// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TemporaryFolder_h
#define freespace_TemporaryFolder_h

#include <filesystem>
#include <fstream>
#include <string>

#include <stdlib.h>

namespace freespace
{

/// A folder of a test's own, removed with all that is in it.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string pattern =
      (std::filesystem::temp_directory_path() / "freespace-test-XXXXXX").string();
    this->Folder = mkdtemp(pattern.data());
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string Path(const std::string& name = "") const { return (this->Folder / name).string(); }

  /// Writes a file, with the folders that it needs, and returns its path.
  std::string Write(const std::string& name, const std::string& content) const
  {
    std::filesystem::create_directories((this->Folder / name).parent_path());
    std::ofstream(this->Folder / name, std::ios::binary) << content;
    return this->Path(name);
  }

private:
  std::filesystem::path Folder;
};

}

#endif
