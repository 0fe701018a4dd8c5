// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/ShellCommand.h"

namespace freespace
{

std::string QuoteForShell(const std::string& word)
{
  const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
  {
    return word;
  }
  std::string quoted = "'";
  for (const char c : word)
  {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

std::string ShellCommand(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words)
  {
    line += (line.empty() ? "" : " ") + QuoteForShell(word);
  }
  return line;
}

}
