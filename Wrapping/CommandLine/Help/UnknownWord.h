// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UnknownWord_h
#define freespace_UnknownWord_h

#include <CLI/CLI.hpp>

#include <string>

namespace freespace
{

/// What to say about a command that there is not on the parsed command line; empty when there is none.
std::string UnknownCommand(const CLI::App& program);

/// The same about an option.
std::string UnknownOption(const CLI::App& program);

}

#endif
