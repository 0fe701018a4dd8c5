// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AtomicOutput_h
#define freespace_AtomicOutput_h

#include "Common/Error.h"

#include <filesystem>
#include <string>

namespace freespace
{

/// A folder beside a target in which its files are made, so that the target is either the old one or
/// the whole new one. What was not committed is removed by the destructor.
class AtomicOutput
{
public:
  /// Throws Error naming the target when its folder cannot be written.
  explicit AtomicOutput(const std::string& target);
  ~AtomicOutput();
  AtomicOutput(const AtomicOutput&) = delete;
  AtomicOutput& operator=(const AtomicOutput&) = delete;

  /// Where to write the target; other files may be written beside it.
  std::string Path() const { return (this->Folder / this->Target.filename()).string(); }

  /// Writes all of the target at once. Throws Failure.
  void Write(const void* bytes, std::size_t count) const;

  /// What to throw where the target could not be written.
  Error Failure() const;

  /// Moves all that was written into the target's folder. Folders beside a target, such as the NAME of
  /// NAME.vtm, may be somebody's own: what they hold stays, but for NAME_0.vtp, NAME_1.vtp, ..., the
  /// parts of a former target. Throws Error when that fails.
  void Commit();

private:
  std::filesystem::path Target;
  std::filesystem::path Folder;
};

}

#endif
