// SPDX-License-Identifier: BSD-3-Clause
#include "Help/HelpFormatter.h"

#include <sstream>

namespace freespace
{

namespace
{

constexpr std::size_t column = 26; // where descriptions begin

// A term and, beside or below it, its description.
std::string Entry(const std::string& term, const std::string& description)
{
  std::string entry = "  " + term;
  if (entry.size() + 2 > column)
  {
    entry += "\n" + std::string(column, ' ');
  }
  else
  {
    entry.resize(column, ' ');
  }
  return entry + Wrapped(description, column, column) + "\n";
}

std::string Entry(const OptionText& option)
{
  std::string term;
  for (const std::string& name : option.names)
  {
    term += (term.empty() ? "" : ",") + name;
  }
  term += option.value.empty() ? "" : " " + option.value;
  return Entry(term + (option.isRepeated ? " ..." : ""), option.description);
}

std::string Section(const std::string& title, const std::vector<OptionText>& options)
{
  std::string section;
  for (const OptionText& option : options)
  {
    section += Entry(option);
  }
  return section.empty() ? "" : "\n" + Wrapped(title, 0, 0) + ":\n" + section;
}

// Prose is wrapped; a long example goes on after a backslash, so that a shell takes it as it is.
std::string Footer(const std::string& footer)
{
  std::istringstream lines(footer);
  std::string text;
  for (std::string line; std::getline(lines, line);)
  {
    const bool isExample = line.rfind("  ", 0) == 0;
    if (line.size() <= 80)
    {
      text += line + "\n";
      continue;
    }
    std::istringstream wrapped(isExample ? Wrapped(line, 6, 2, 78) : Wrapped(line, 0, 0));
    std::string begin = isExample ? "  " : "";
    for (std::string part; std::getline(wrapped, part); begin = isExample ? " \\\n" : "\n")
    {
      text += begin + part;
    }
    text += "\n";
  }
  return text;
}

}

std::string HelpText(const CommandText& text)
{
  std::string help = Wrapped(text.description, 0, 0) + "\n";
  help += "Usage: " + Wrapped(text.Usage(), 7, 7) + "\n";
  help += Section("Arguments", text.positionals);
  for (const OptionGroupText& group : text.groups)
  {
    help += Section(group.title, group.options);
  }
  help += Section("Options of every command", text.shared);
  if (!text.commands.empty())
  {
    help += "\nCommands:\n";
    for (const auto& [name, description] : text.commands)
    {
      help += Entry(name, description);
    }
  }
  return text.footer.empty() ? help : help + "\n" + Footer(text.footer);
}

}
