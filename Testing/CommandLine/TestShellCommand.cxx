// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/ShellCommand.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

using namespace freespace;

namespace
{

// What a POSIX shell makes of a command line's words.
std::vector<std::string> WordsInShell(const std::string& command)
{
  const std::string line = "for w in " + command + "; do printf '%s\\0' \"$w\"; done";
  std::string output;
  FILE* pipe = popen(("LC_ALL=C " + std::string("sh -c ") + QuoteForShell(line)).c_str(), "r");
  std::array<char, 256> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
  {
    output.append(buffer.data(), n);
  }
  pclose(pipe);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < output.size();)
  {
    const std::size_t end = output.find('\0', at);
    words.push_back(output.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

}

TEST(Shell, LeavesPlainWords)
{
  EXPECT_EQ(ShellCommand({ "freespace", "report", "a/b_c-1.json", "--cells", "256" }),
    "freespace report a/b_c-1.json --cells 256");
}

TEST(Shell, TakesEveryWordBackAsItWas)
{
  const std::vector<std::string> words = { "", " ", "a b", "it's", "'", "''", "$HOME", "`id`",
    "a\\b", "a\nb", "*", "~", "#x", "-o", "\"", "!", "Würfel", ";rm -rf x", "a'$(id)'b" };
  EXPECT_EQ(WordsInShell(ShellCommand(words)), words);
}

TEST(Shell, TakesRandomWordsBack)
{
  std::mt19937 random(7);
  std::vector<std::string> words;
  for (int i = 0; i < 50; ++i)
  {
    std::string word;
    for (int k = random() % 12; k > 0; --k)
    {
      word += static_cast<char>(1 + random() % 126);
    }
    words.push_back(word);
  }
  EXPECT_EQ(WordsInShell(ShellCommand(words)), words);
}
