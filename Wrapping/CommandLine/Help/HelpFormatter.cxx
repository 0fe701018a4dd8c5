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
  return text.footer.empty() ? help : help + "\n" + text.footer + "\n";
}

}
