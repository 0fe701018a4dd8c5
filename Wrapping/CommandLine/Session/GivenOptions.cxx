// SPDX-License-Identifier: BSD-3-Clause
#include "Session/GivenOptions.h"

namespace freespace
{

std::vector<std::string> GivenOptions(const CLI::App& command, const std::string& group)
{
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() == 0 || option->get_group() != group || option->get_positional())
    {
      continue;
    }
    words.push_back("--" + option->get_single_name());
    if (option->get_items_expected_max() > 0) // a flag has none
    {
      const std::vector<std::string> values = option->results();
      words.insert(words.end(), values.begin(), values.end());
    }
  }
  return words;
}

}
