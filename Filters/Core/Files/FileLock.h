// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FileLock_h
#define freespace_FileLock_h

#include <filesystem>

namespace freespace
{

/// A file or folder that is locked against other processes, and against further locks of this one, until the
/// lock is destroyed or the process ends. Advisory: it stops only those who ask for the lock, too.
class FileLock
{
public:
  FileLock() = default;                ///< holds nothing
  FileLock(FileLock&& other) noexcept; ///< the other one holds nothing then
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  /// Holds nothing where another one has the lock, or where the path cannot be opened.
  static FileLock Try(const std::filesystem::path& path);

  /// Waits for another one that has the lock. Holds nothing where the path cannot be opened; where the file
  /// system has no locks, the lock locks nobody out.
  static FileLock Wait(const std::filesystem::path& path);

  bool IsHeld() const { return this->Descriptor >= 0; }

private:
  explicit FileLock(int descriptor)
    : Descriptor(descriptor)
  {
  }

  int Descriptor = -1;
};

}

#endif
