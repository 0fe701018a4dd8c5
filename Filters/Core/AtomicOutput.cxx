// SPDX-License-Identifier: BSD-3-Clause
#include "AtomicOutput.h"

#include "Error.h"

#include <vector>

#include <stdlib.h>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

fs::path MakeFolderBeside(const fs::path& target)
{
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!target.has_filename() || !fs::is_directory(parent))
  {
    throw Error("Cannot write " + target.string() + ": there is no folder " + parent.string() + ".");
  }
  std::string pattern = (parent / ".freespace-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
  {
    throw Error("Cannot write " + target.string() + ": the folder " + parent.string()
      + " is not writable.");
  }
  return pattern;
}

// A folder cannot be renamed onto one that has files: the old one goes aside first.
void Replace(const fs::path& from, const fs::path& to, const fs::path& aside)
{
  if (fs::is_directory(to))
  {
    fs::rename(to, aside);
  }
  fs::rename(from, to);
}

}

AtomicOutput::AtomicOutput(const std::string& target)
  : Target(target)
  , Folder(MakeFolderBeside(target))
{
}

AtomicOutput::~AtomicOutput()
{
  std::error_code ignored;
  fs::remove_all(this->Folder, ignored);
}

void AtomicOutput::Commit()
{
  if (!fs::exists(this->Path()))
  {
    throw Error("Cannot write " + this->Target.string() + ": nothing was written.");
  }
  try
  {
    // The target itself last: it refers to the others.
    const fs::path parent = this->Target.has_parent_path() ? this->Target.parent_path() : ".";
    std::vector<fs::path> companions;
    for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder))
    {
      if (entry.path().filename() != this->Target.filename())
      {
        companions.push_back(entry.path());
      }
    }
    for (const fs::path& companion : companions)
    {
      Replace(companion, parent / companion.filename(),
        this->Folder / ("replaced-" + companion.filename().string()));
    }
    fs::rename(this->Path(), this->Target);
  }
  catch (const fs::filesystem_error& error)
  {
    throw Error("Cannot write " + this->Target.string() + ": " + error.code().message() + ".");
  }
}

}
