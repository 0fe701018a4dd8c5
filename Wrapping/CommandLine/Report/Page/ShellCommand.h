// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ShellCommand_h
#define freespace_ShellCommand_h

#include <string>
#include <vector>

namespace freespace
{

/// A word quoted for a POSIX shell: unchanged if it has no special characters, else in single quotes.
std::string QuoteForShell(const std::string& word);

/// The words of a command, quoted where necessary.
std::string ShellCommand(const std::vector<std::string>& words);

}

#endif
