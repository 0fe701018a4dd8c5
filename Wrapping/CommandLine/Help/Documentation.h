// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Documentation_h
#define freespace_Documentation_h

#include <CLI/CLI.hpp>

#include <string>

namespace freespace
{

/// Writes man/man1 with a page of the program and of each command, bash-completion/completions/freespace and
/// zsh/vendor-completions/_freespace into a folder: what a package installs below share. Throws Error.
void WriteDocumentation(
  const CLI::App& program, const std::string& version, const std::string& folder);

}

#endif
