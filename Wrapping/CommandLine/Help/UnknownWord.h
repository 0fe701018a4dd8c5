// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UnknownWord_h
#define freespace_UnknownWord_h

#include <CLI/CLI.hpp>

#include <string>

namespace freespace
{

/// The message about an unknown command on the parsed command line; empty if there is none.
std::string UnknownCommand(const CLI::App& program);

/// The same for an option.
std::string UnknownOption(const CLI::App& program);

}

#endif
