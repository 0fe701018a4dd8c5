// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileLock.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace freespace
{

FileLock::FileLock(FileLock&& other) noexcept
  : Descriptor(std::exchange(other.Descriptor, -1))
{
}

FileLock& FileLock::operator=(FileLock&& other) noexcept
{
  std::swap(this->Descriptor, other.Descriptor);
  return *this;
}

FileLock::~FileLock()
{
  if (this->Descriptor >= 0)
  {
    close(this->Descriptor);
  }
}

FileLock FileLock::Try(const std::filesystem::path& path)
{
  FileLock lock(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return lock.IsHeld() && flock(lock.Descriptor, LOCK_EX | LOCK_NB) == 0 ? std::move(lock)
                                                                         : FileLock();
}

FileLock FileLock::Wait(const std::filesystem::path& path)
{
  FileLock lock(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  while (lock.IsHeld() && flock(lock.Descriptor, LOCK_EX) != 0 && errno == EINTR)
  {
    // A signal came while it waited.
  }
  return lock;
}

}
