// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LibraryWords_h
#define freespace_LibraryWords_h

#include <string>
#include <vector>

namespace freespace
{

/// Keeps from the standard error, while it lives, what libraries write there by themselves: those that read
/// pictures do, beside telling the caller that they failed. Where the process is aborted it is written after
/// all. There may be one at a time.
class LibraryWords
{
public:
  LibraryWords();
  ~LibraryWords();
  LibraryWords(const LibraryWords&) = delete;
  LibraryWords& operator=(const LibraryWords&) = delete;

  /// The lines so far, each once.
  std::vector<std::string> Lines() const;
};

}

#endif
