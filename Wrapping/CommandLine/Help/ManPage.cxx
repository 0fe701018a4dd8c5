// SPDX-License-Identifier: BSD-3-Clause
#include "Help/ManPage.h"

#include <algorithm>
#include <sstream>

namespace freespace
{

namespace
{

// Backslashes and dashes mean something to roff, and so do a dot and a quote that begin a line.
std::string Escaped(const std::string& text)
{
  std::string escaped;
  bool isBegun = false;
  for (const char c : text)
  {
    if (!isBegun && (c == '.' || c == '\''))
    {
      escaped += "\\&";
    }
    if (c == '\\')
    {
      escaped += "\\e";
    }
    else if (c == '-')
    {
      escaped += "\\-";
    }
    else
    {
      escaped += c;
    }
    isBegun = c != '\n';
  }
  return escaped;
}

std::string Dashed(std::string name)
{
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string ManEntry(const OptionText& option)
{
  std::string entry = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
  {
    entry += (i == 0 ? "\\fB" : ", \\fB") + Escaped(option.names[i]) + "\\fR";
  }
  entry += option.value.empty() ? "" : " \\fI" + Escaped(option.value) + "\\fR";
  entry += option.isRepeated ? " ..." : "";
  return entry + "\n" + Escaped(option.description) + "\n";
}

std::string ManSection(const std::string& title, const std::vector<OptionText>& options)
{
  std::string section = options.empty() ? "" : ".SS \"" + Escaped(title) + "\"\n";
  for (const OptionText& option : options)
  {
    section += ManEntry(option);
  }
  return section;
}

std::string Examples(const std::string& footer)
{
  std::istringstream lines(footer);
  std::string text;
  bool isCode = false;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.rfind("Example", 0) == 0)
    {
      continue;
    }
    const bool startsCode = line.rfind("  ", 0) == 0;
    if (startsCode != isCode)
    {
      text += startsCode ? ".nf\n" : ".fi\n";
      isCode = startsCode;
    }
    text += Escaped(startsCode ? line.substr(2) : line) + "\n";
  }
  return footer.empty() ? "" : ".SH EXAMPLES\n" + text + (isCode ? ".fi\n" : "");
}

std::string SeeAlso(const CommandText& text)
{
  if (text.commands.empty())
  {
    return ".SH SEE ALSO\n.BR freespace (1)\n";
  }
  std::string pages;
  for (const auto& command : text.commands)
  {
    pages += (pages.empty() ? "" : " ,\n") +
      std::string(".BR freespace\\-" + Escaped(command.first) + " (1)");
  }
  return ".SH SEE ALSO\n" + pages + "\n";
}

}

std::string ManPage(const CommandText& text, const std::string& version)
{
  std::string description = text.description;
  if (!description.empty() && description.back() == '.')
  {
    description.pop_back();
  }
  const std::string name = Dashed(text.name);
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page =
    ".TH \"" + upper + "\" 1 \"\" \"Freespace " + version + "\" \"User Commands\"\n";
  page += ".SH NAME\n" + Escaped(name) + " \\- " + Escaped(description) + "\n";
  page += ".SH SYNOPSIS\n.B " + Escaped(text.Usage()) + "\n";
  page += ".SH DESCRIPTION\n" + Escaped(text.description) +
    (text.description.empty() || text.description.back() == '.' ? "" : ".") + "\n";
  page += ".SH OPTIONS\n" + ManSection("Arguments", text.positionals);
  for (const OptionGroupText& group : text.groups)
  {
    page += ManSection(group.title, group.options);
  }
  page += ManSection("Options of every command", text.shared);
  for (const auto& [command, what] : text.commands)
  {
    page += command == text.commands.front().first ? ".SH COMMANDS\n" : "";
    page += ".TP\n\\fB" + Escaped(command) + "\\fR\n" + Escaped(what) + "\n";
  }
  page +=
    ".SH EXIT STATUS\n0 after success, 1 after an error, 2 for a command line that is wrong, 130 "
    "after an interrupt.\n";
  return page + Examples(text.footer) + SeeAlso(text);
}

}
