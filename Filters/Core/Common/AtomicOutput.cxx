// SPDX-License-Identifier: BSD-3-Clause
#include "Common/AtomicOutput.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

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
    throw Error(
      "Cannot write " + target.string() + ": there is no folder " + parent.string() + ".");
  }
  std::string pattern = (parent / ".freespace-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
  {
    throw Error(
      "Cannot write " + target.string() + ": the folder " + parent.string() + " is not writable.");
  }
  return pattern;
}

// Whether a file can grow by some bytes, which it then does not. Many writers do not look at what the
// disk says: what ends where nothing more can be written must be taken for cut off.
bool CanGrow(const fs::path& file, std::size_t bytes)
{
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  if (descriptor < 0)
  {
    return false;
  }
  const off_t size = lseek(descriptor, 0, SEEK_END);
  const std::vector<char> some(bytes, 0);
  const bool grew = write(descriptor, some.data(), bytes) == static_cast<ssize_t>(bytes);
  const bool shrank = ftruncate(descriptor, size) == 0;
  return close(descriptor) == 0 && grew && shrank;
}

// Whether all that was written beside a target seems to be whole.
bool IsWhole(const fs::path& folder)
{
  constexpr std::size_t block = 1 << 16;
  const fs::path probe = folder / ".probe";
  const bool hasRoom = CanGrow(probe, block);
  fs::remove(probe);
  const fs::recursive_directory_iterator files(folder);
  return hasRoom &&
    std::all_of(begin(files), end(files),
      [](const fs::directory_entry& entry)
      { return !entry.is_regular_file() || CanGrow(entry.path(), 1); });
}

// Whether a file in a target's companion folder has the name of a part of it: STEM_3.vtp.
bool IsPart(const fs::path& file, const std::string& stem)
{
  const std::string name = file.stem().string(), begin = stem + "_";
  return fs::is_regular_file(file) && file.extension() == ".vtp" && name.size() > begin.size() &&
    name.compare(0, begin.size(), begin) == 0 &&
    std::all_of(
      name.begin() + begin.size(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// A folder that is already there may be somebody's own and hold other things, which stay: only the
// parts of a former target make room, going aside, and the new ones move in.
void MoveInto(const fs::path& from, const fs::path& to, const fs::path& aside)
{
  fs::create_directory(aside);
  const fs::directory_iterator old(to);
  std::vector<fs::path> parts;
  std::copy_if(begin(old), end(old), std::back_inserter(parts),
    [&](const fs::path& file) { return IsPart(file, to.filename().string()); });
  for (const fs::path& part : parts)
  {
    fs::rename(part, aside / part.filename());
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(from))
  {
    fs::rename(entry.path(), to / entry.path().filename());
  }
}

void Replace(const fs::path& from, const fs::path& to, const fs::path& aside)
{
  if (fs::is_directory(to) && fs::is_directory(from))
  {
    MoveInto(from, to, aside);
    return;
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

void AtomicOutput::Write(const void* bytes, std::size_t count) const
{
  std::ofstream file(this->Path(), std::ios::binary);
  file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  file.close();
  if (!file)
  {
    throw this->Failure();
  }
}

Error AtomicOutput::Failure() const
{
  return Error("Cannot write " + this->Target.string() +
    ": the disk is full, or the file is larger than is allowed.");
}

void AtomicOutput::Commit()
{
  if (!fs::exists(this->Path()))
  {
    throw Error("Cannot write " + this->Target.string() + ": nothing was written.");
  }
  try
  {
    if (!IsWhole(this->Folder))
    {
      throw this->Failure();
    }
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
