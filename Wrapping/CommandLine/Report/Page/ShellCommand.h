// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ShellCommand_h
#define freespace_ShellCommand_h

#include <string>
#include <vector>

namespace freespace
{

/// A word as a POSIX shell wants it: as it is where nothing in it means anything to the shell, else
/// between single quotes.
std::string QuoteForShell(const std::string& word);

/// Words of a command, each quoted where need be.
std::string ShellCommand(const std::vector<std::string>& words);

}

#endif
