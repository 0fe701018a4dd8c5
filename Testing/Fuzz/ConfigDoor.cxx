// SPDX-License-Identifier: BSD-3-Clause
// The door of --config: the program's own reading of its options, without what it does then.
#include "Doors.h"

#define main FreespaceMain
#include "../../Wrapping/CommandLine/main.cxx"
#undef main

#include <stdexcept>

namespace freespace
{

namespace
{

void EnterConfig(std::string_view bytes)
{
  PutFile("options.ini", bytes);
  const std::string file = FuzzFolder() + "/options.ini";
  for (const bool hasCommand : { false, true })
  {
    CLI::App program;
    Session session;
    DescribeProgram(program);
    session.AddOptions(program);
    AddCommands(program, session);
    std::vector<std::string> words = { "freespace", "--config", file };
    if (hasCommand)
    {
      words.insert(words.end(), { "contour", "maps.vtm", "-o", "out.ply" });
    }
    std::vector<char*> arguments;
    for (std::string& word : words)
    {
      arguments.push_back(word.data());
    }
    const auto count = static_cast<int>(arguments.size());
    LetConfigRunCommands(program, count, arguments.data());
    try
    {
      program.parse(count, arguments.data());
    }
    catch (const CLI::Success&)
    {
      // It may ask for help.
    }
    catch (const CLI::ParseError& error)
    {
      if (Fault(program, error, words).empty())
      {
        throw std::logic_error("A fault of the options is not told.");
      }
    }
  }
}

}

std::vector<Door> Doors()
{
  return { { "config", EnterConfig } };
}

}
