// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicOutput.h"

#include "Common/ParseNumber.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

fs::path ParentOf(const fs::path& target)
{
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

// Where a target's bytes go: what a symbolic link points to, which need not be there yet.
fs::path BehindLinks(const fs::path& target)
{
  constexpr int mostLinks = 40; // as the kernel
  fs::path path = target;
  std::error_code error;
  for (int i = 0; i < mostLinks && fs::is_symlink(path, error); ++i)
  {
    const fs::path next = fs::read_symlink(path, error);
    path = next.is_absolute() ? next : ParentOf(path) / next;
  }
  if (fs::is_symlink(path, error))
  {
    throw Error("Cannot write " + target.string() + ": its symbolic links go in a circle.");
  }
  return path;
}

// Whether a target takes bytes, but is no file.
bool TakesBytes(const fs::path& target)
{
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  const std::string name = target.string();
  if (fs::is_block_file(status) || fs::is_socket(status))
  {
    throw Error("Cannot write " + name + ": it is a disk or a socket.");
  }
  if (fs::is_directory(status))
  {
    throw Error("Cannot write " + name + ": it is a folder.");
  }
  if (fs::exists(status) && access(target.c_str(), W_OK) != 0)
  {
    throw Error("Cannot write " + name + ": it is write-protected.");
  }
  return fs::is_fifo(status) || fs::is_character_file(status);
}

// The folder that a target's files are made in.
fs::path WorkPlaceOf(const fs::path& target, bool isStream)
{
  const fs::path parent = ParentOf(target);
  if (!target.has_filename() || !fs::is_directory(parent))
  {
    throw Error(
      "Cannot write " + target.string() + ": there is no folder " + parent.string() + ".");
  }
  return isStream ? fs::temp_directory_path() : parent;
}

// Puts a file or folder on the disk, so that it is there after a loss of power.
void Sync(const fs::path& path)
{
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool isSynced = descriptor >= 0 && (fsync(descriptor) == 0 || errno != EIO);
  if (descriptor >= 0)
  {
    close(descriptor);
  }
  if (!isSynced)
  {
    throw fs::filesystem_error("", std::error_code(EIO, std::generic_category()));
  }
}

// The new file gets the old one's mode and, where that is allowed, its owner.
void KeepModeAndOwner(const fs::path& from, const fs::path& to)
{
  struct stat old;
  if (stat(to.c_str(), &old) != 0 || !S_ISREG(old.st_mode))
  {
    return;
  }
  // The owner first: it takes away set-user-ID bits.
  if (chown(from.c_str(), old.st_uid, old.st_gid) != 0 &&
    chown(from.c_str(), static_cast<uid_t>(-1), old.st_gid) != 0)
  {
    // It stays this user's, who may not give it away.
  }
  chmod(from.c_str(), old.st_mode & 07777);
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
  constexpr std::size_t bytes = 1 << 16;
  const fs::path probe = folder / ".probe";
  const bool hasRoom = CanGrow(probe, bytes);
  fs::remove(probe);
  const fs::recursive_directory_iterator files(folder);
  return hasRoom &&
    std::all_of(begin(files), end(files),
      [](const fs::directory_entry& entry)
      { return !entry.is_regular_file() || CanGrow(entry.path(), 1); });
}

// The number of a file in a target's companion folder that has the name of a part of it: STEM_3.vtp. -1: it
// has not.
int PartNumber(const fs::path& file, const std::string& stem)
{
  const std::string name = file.stem().string(), begin = stem + "_";
  if (file.extension() != ".vtp" || name.compare(0, begin.size(), begin) != 0 ||
    !fs::is_regular_file(file))
  {
    return -1;
  }
  const std::string number = name.substr(begin.size());
  const bool isNumber = !number.empty() &&
    std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  return isNumber ? ParseNumber<int>(number).value_or(-1) : -1;
}

std::vector<int> PartNumbers(const fs::path& folder)
{
  std::vector<int> numbers;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
  {
    const int number = PartNumber(entry.path(), folder.filename().string());
    if (number >= 0)
    {
      numbers.push_back(number);
    }
  }
  return numbers;
}

/// The renames of a commit, which are undone unless it is complete.
class Renames
{
public:
  explicit Renames(const fs::path& workFolder)
    : Aside(workFolder / ".replaced")
  {
  }
  ~Renames()
  {
    std::error_code ignored;
    for (auto move = this->Done.rbegin(); move != this->Done.rend() && !this->IsComplete; ++move)
    {
      fs::rename(move->second, move->first, ignored);
    }
  }
  Renames(const Renames&) = delete;
  Renames& operator=(const Renames&) = delete;

  void Move(const fs::path& from, const fs::path& to)
  {
    if (fs::exists(fs::symlink_status(to)) && !fs::is_directory(to))
    {
      // Aside until the end: what is replaced comes back where the commit fails.
      fs::create_directory(this->Aside);
      const fs::path aside = this->Aside / std::to_string(this->Done.size());
      std::error_code hasNoLinks;
      fs::create_hard_link(to, aside, hasNoLinks);
      if (hasNoLinks)
      {
        fs::rename(to, aside);
      }
      this->Done.emplace_back(to, aside);
      fs::rename(from, to);
      return;
    }
    fs::rename(from, to);
    this->Done.emplace_back(from, to);
  }

  // A folder that is already there may be somebody's own and hold other things, which stay.
  void MoveInto(const fs::path& from, const fs::path& to)
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(from))
    {
      this->Move(entry.path(), to / entry.path().filename());
    }
    Sync(to);
  }

  void Complete() { this->IsComplete = true; }

private:
  fs::path Aside;
  std::vector<std::pair<fs::path, fs::path>> Done;
  bool IsComplete = false;
};

// Holds a folder against other processes until no output of this one does any more: a second lock would wait
// for the first, even in one process. Null where the folder cannot be opened.
std::shared_ptr<FileLock> LockOfFolder(const fs::path& folder)
{
  static auto* mutex = new std::mutex;
  static auto* held = new std::map<std::pair<dev_t, ino_t>, std::weak_ptr<FileLock>>;
  struct stat status = {};
  if (stat(folder.c_str(), &status) != 0)
  {
    return nullptr;
  }
  const std::lock_guard<std::mutex> guard(*mutex);
  std::weak_ptr<FileLock>& known = (*held)[{ status.st_dev, status.st_ino }];
  std::shared_ptr<FileLock> lock = known.lock();
  if (!lock)
  {
    lock = std::make_shared<FileLock>(FileLock::Wait(folder));
    known = lock;
  }
  return lock;
}

}

AtomicOutput::AtomicOutput(const std::string& target)
  : Target(BehindLinks(target))
  , IsStream(TakesBytes(this->Target))
  , Folder(WorkPlaceOf(this->Target, this->IsStream))
{
  if (this->Folder.Path().empty())
  {
    throw Error("Cannot write " + target + ": the folder " + ParentOf(this->Target).string() +
      " is not writable.");
  }
}

void AtomicOutput::Hold()
{
  const fs::path folder = ParentOf(this->Target);
  // A work folder of this process is locked, and no other process writes there.
  if (!this->Lock && !this->IsStream && !IsOwnWorkFolder(folder))
  {
    this->Lock = LockOfFolder(folder);
  }
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

NoRoom AtomicOutput::Failure() const
{
  return NoRoom("Cannot write " + this->Target.string() +
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
    if (!IsWhole(this->Folder.Path()))
    {
      throw this->Failure();
    }
    if (this->IsStream)
    {
      this->Stream();
    }
    else
    {
      this->CommitFiles();
    }
  }
  catch (const fs::filesystem_error& error)
  {
    throw Error("Cannot write " + this->Target.string() + ": " + error.code().message() + ".");
  }
}

// The target itself last: it refers to the others, and with its rename the old is the new.
void AtomicOutput::CommitFiles()
{
  const fs::path parent = ParentOf(this->Target);
  std::vector<fs::path> companions;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder.Path()))
  {
    if (entry.path().filename() != this->Target.filename())
    {
      companions.push_back(entry.path());
    }
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(this->Folder.Path()))
  {
    Sync(entry.path());
  }
  this->Hold();
  const auto hold = HoldWorkFolders();
  Renames renames(this->Folder.Path());
  std::vector<fs::path> formerParts;
  for (const fs::path& companion : companions)
  {
    const fs::path place = parent / companion.filename();
    if (!fs::is_directory(companion) || !fs::is_directory(place))
    {
      KeepModeAndOwner(companion, place);
      renames.Move(companion, place);
      continue;
    }
    for (const int number : PartNumbers(place))
    {
      const std::string name = place.filename().string() + "_" + std::to_string(number) + ".vtp";
      if (!fs::exists(companion / name))
      {
        formerParts.push_back(place / name);
      }
    }
    renames.MoveInto(companion, place);
  }
  KeepModeAndOwner(this->Path(), this->Target);
  Sync(parent);
  fs::rename(this->Path(), this->Target);
  renames.Complete();
  Sync(parent);
  std::error_code ignored; // they are in nobody's way, and go with the next commit
  for (const fs::path& part : formerParts)
  {
    fs::remove(part, ignored);
  }
}

// Gives the bytes to a pipe or a device, which cannot take them back.
void AtomicOutput::Stream()
{
  const fs::directory_iterator files(this->Folder.Path());
  if (std::distance(begin(files), end(files)) > 1)
  {
    throw Error("Cannot write " + this->Target.string() +
      ": it is no file, and this format has several files.");
  }
  std::ifstream from(this->Path(), std::ios::binary);
  std::ofstream to(this->Target, std::ios::binary);
  to << from.rdbuf();
  to.close();
  if (!to)
  {
    throw Error("Cannot write " + this->Target.string() + ": it takes no more bytes.");
  }
}

int AtomicOutput::FirstFreePart(int parts)
{
  this->Hold();
  const std::vector<int> taken = PartNumbers(ParentOf(this->Target) / this->Target.stem());
  const bool isFree =
    std::all_of(taken.begin(), taken.end(), [parts](int number) { return number >= parts; });
  return isFree ? 0 : *std::max_element(taken.begin(), taken.end()) + 1;
}

}
