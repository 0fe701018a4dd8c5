// SPDX-License-Identifier: BSD-3-Clause
#include "Help/CommandText.h"

#include "Help/HelpFormatter.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

using namespace freespace;

TEST(Wrapped, KeepsTheWordsAndTheColumns)
{
  std::mt19937 random(7);
  std::uniform_int_distribution<std::size_t> length(1, 20), count(0, 60), indent(0, 30);
  for (int trial = 0; trial < 200; ++trial)
  {
    std::string text;
    for (std::size_t i = count(random); i > 0; --i)
    {
      text += std::string(length(random), static_cast<char>('a' + i % 26)) + " ";
    }
    const std::size_t margin = indent(random);
    const std::string wrapped = Wrapped(text, margin, margin, 60);
    std::istringstream before(text), after(wrapped), lines(wrapped);
    std::string expected, word;
    while (before >> expected)
    {
      ASSERT_TRUE(after >> word);
      EXPECT_EQ(word, expected);
    }
    EXPECT_FALSE(after >> word);
    std::size_t width = margin;
    for (std::string line; std::getline(lines, line); width = 0)
    {
      EXPECT_LE(width + line.size(), 60u);
    }
  }
}

TEST(Wrapped, DoesNotBreakALongWord)
{
  EXPECT_EQ(
    Wrapped("a " + std::string(90, 'x') + " b", 2, 2), "a\n  " + std::string(90, 'x') + "\n  b");
  EXPECT_EQ(Wrapped("", 4, 4), "");
}

namespace
{

struct Program
{
  CLI::App app{ "Does it." };
  int cells = 5;
  std::string file;

  Program()
  {
    app.name("program");
    CLI::App* command = app.add_subcommand("make", "Make the thing");
    auto* option = command->add_option("-c,--cells", cells, "Number of cells")
                     ->check(CLI::Range(1, 9))
                     ->capture_default_str();
    command->add_option("file", file, "What to read")->required();
    command->add_option("--other", file, "Another")->excludes(option);
    command->add_option("--hidden", file, "Not shown")->group("");
  }
};

}

TEST(CommandText, TellsLimitsDefaultsAndExclusions)
{
  const Program program;
  const CommandText text = TextOf(*program.app.get_subcommands({}).front());
  EXPECT_EQ(text.Usage(), "program make [OPTIONS] file");
  const std::string help = HelpText(text);
  EXPECT_NE(help.find("Number of cells (1 to 9; default 5; not with --other)"), std::string::npos);
  EXPECT_EQ(help.find("hidden"), std::string::npos);
}
