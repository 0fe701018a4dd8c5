// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AtomicOutput_h
#define freespace_AtomicOutput_h

#include "Common/Error.h"
#include "Files/FileLock.h"
#include "Files/WorkFolder.h"

#include <filesystem>
#include <memory>
#include <string>

namespace freespace
{

/// Thrown where there is no room for an output.
class NoRoom : public Error
{
public:
  using Error::Error;
};

/// A folder beside a target in which its files are made, so that the target is either the old one or
/// the whole new one, also when the process is killed at any moment. What was not committed is removed by the
/// destructor, or by the next run.
///
/// A target that is a symbolic link is written through it; a pipe or a character device gets the bytes; a
/// former file's mode and, where that is allowed, its owner stay.
class AtomicOutput
{
public:
  /// Throws Error naming the target when its folder cannot be written, when the target is a folder, a disk
  /// or a socket, or when it may not be written.
  explicit AtomicOutput(const std::string& target);
  AtomicOutput(const AtomicOutput&) = delete;
  AtomicOutput& operator=(const AtomicOutput&) = delete;

  /// Lets no other process change outputs in the target's folder until this one is committed or destroyed;
  /// waits for one that does. Where the file system has no locks, nothing is held.
  void Hold();

  /// Where to write the target; other files may be written beside it.
  std::string Path() const { return (this->Folder.Path() / this->Target.filename()).string(); }

  /// The target, behind a symbolic link.
  const std::filesystem::path& Destination() const { return this->Target; }

  /// Writes all of the target at once. Throws Failure.
  void Write(const void* bytes, std::size_t count) const;

  /// What to throw where the target could not be written.
  NoRoom Failure() const;

  /// Moves all that was written into the target's folder. Folders beside a target, such as the NAME of
  /// NAME.vtm, may be somebody's own: what they hold stays, but for NAME_0.vtp, NAME_1.vtp, ..., the
  /// parts of a former target, which are removed last. So that a NAME.vtm changes with its parts, the new ones
  /// need names of their own, see FirstFreePart. Everything is on the disk when this returns. Throws Error
  /// when that fails, and then everything is as it was.
  void Commit();

  /// The first number n for which none of the names NAME_n.vtp, ... of this number of parts is taken in the folder NAME
  /// of a NAME.vtm. It stays free until the commit, see Hold.
  int FirstFreePart(int parts);

private:
  void CommitFiles();
  void Stream();

  std::filesystem::path Target;
  bool IsStream; ///< whether the target is no file, but takes bytes
  WorkFolder Folder;
  std::shared_ptr<FileLock> Lock; ///< where the target's folder is held
};

}

#endif
