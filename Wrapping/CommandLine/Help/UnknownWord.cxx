// SPDX-License-Identifier: BSD-3-Clause
#include "Help/UnknownWord.h"

#include "Help/CommandText.h"
#include "Help/Suggestion.h"

#include <algorithm>

namespace freespace
{

namespace
{

std::string Sentence(const std::string& kind, const std::string& word,
  const std::vector<std::string>& known, const std::string& command)
{
  const std::string closest = ClosestWord(word, known);
  return "There is no " + kind + " '" + word + "'" +
    (closest.empty() ? "" : "; did you mean '" + closest + "'?") +
    (closest.empty() ? "; '" : " '") + command + " --help' lists them.";
}

}

std::string UnknownCommand(const CLI::App& program)
{
  const std::vector<std::string> unknown = program.remaining();
  if (!program.get_subcommands().empty() || unknown.empty() || unknown[0].rfind('-', 0) == 0)
  {
    return "";
  }
  std::vector<std::string> known;
  for (const auto& command : TextOf(program).commands)
  {
    known.push_back(command.first);
  }
  return Sentence("command", unknown[0], known, program.get_name());
}

std::string UnknownOption(const CLI::App& program)
{
  const std::vector<std::string> unknown = program.remaining(true);
  const auto option = std::find_if(unknown.begin(), unknown.end(),
    [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  if (option == unknown.end())
  {
    return "";
  }
  const std::vector<CLI::App*> commands = program.get_subcommands();
  const CommandText text = TextOf(commands.empty() ? program : *commands.front());
  std::vector<std::string> known;
  for (const OptionText& each : text.AllOptions())
  {
    known.insert(known.end(), each.names.begin(), each.names.end());
  }
  return Sentence("option", option->substr(0, option->find('=')), known, text.name);
}

}
