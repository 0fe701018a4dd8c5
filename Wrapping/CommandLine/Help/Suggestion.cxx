// SPDX-License-Identifier: BSD-3-Clause
#include "Help/Suggestion.h"

#include <algorithm>

namespace freespace
{

namespace
{

// Of optimal string alignment: neighbours that are swapped count once.
std::size_t Distance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> table(
    a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
  for (std::size_t i = 0; i <= a.size(); ++i)
  {
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      if (i == 0 || j == 0)
      {
        table[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      table[i][j] =
        std::min({ table[i - 1][j] + 1, table[i][j - 1] + 1, table[i - 1][j - 1] + change });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
      }
    }
  }
  return table[a.size()][b.size()];
}

std::string WithoutDashes(const std::string& word)
{
  return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

}

std::string ClosestWord(const std::string& word, const std::vector<std::string>& known)
{
  const std::string letters = WithoutDashes(word);
  std::string closest;
  std::size_t least = std::max<std::size_t>(letters.size() / 3, 1) + 1;
  for (const std::string& candidate : known)
  {
    const std::string others = WithoutDashes(candidate);
    const std::size_t distance = Distance(letters, others);
    if (distance < least && distance < others.size())
    {
      least = distance;
      closest = candidate;
    }
  }
  return closest;
}

}
