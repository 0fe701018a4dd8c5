// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CommandText_h
#define freespace_CommandText_h

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace freespace
{

/// The documentation of an option or a positional argument.
struct OptionText
{
  std::vector<std::string> names; ///< as one types them: -o, --output; of a positional its name
  std::string value;              ///< what follows: OUT.png; empty for a flag
  std::string description;        ///< with default, limits and what it excludes
  bool isRequired = false;
  bool isRepeated = false; ///< takes several values
};

struct OptionGroupText
{
  std::string title;
  std::vector<OptionText> options;
};

/// The documentation of the program or a command. Help, man pages and shell completion are all made from
/// it.
struct CommandText
{
  std::string name; ///< freespace, or freespace contour
  std::string description;
  std::vector<OptionText> positionals;
  std::vector<OptionGroupText> groups;                       ///< the command's own options
  std::vector<OptionText> shared;                            ///< those of every command
  std::vector<std::pair<std::string, std::string>> commands; ///< names and descriptions
  std::string footer;

  /// All options with a dash.
  std::vector<OptionText> AllOptions() const;

  /// "freespace contour [OPTIONS] maps".
  std::string Usage() const;
};

CommandText TextOf(const CLI::App& app);

/// The text of the program and, in their order, of its commands.
std::vector<CommandText> TextsOf(const CLI::App& program);

/// The paragraphs of a text in lines of at most this many columns, the first one starting at column `begun`,
/// all others indented. Words are not broken.
std::string Wrapped(
  const std::string& text, std::size_t indent, std::size_t begun, std::size_t columns = 80);

}

#endif
