// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GivenOptions_h
#define freespace_GivenOptions_h

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace freespace
{

/// The options of a group that the command line or the config file gave, as words of a command that
/// gives them again: { "--cells", "256", "--no-sharp" }. Positional arguments have no part in it.
std::vector<std::string> GivenOptions(const CLI::App& command, const std::string& group);

}

#endif
