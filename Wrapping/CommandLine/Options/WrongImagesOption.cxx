// SPDX-License-Identifier: BSD-3-Clause
#include "Options/WrongImagesOption.h"

namespace freespace
{

void WrongImagesOption::AddTo(CLI::App& command, const std::string& group)
{
  const std::string name = "--wrong-images";
  this->Option = command.get_option_no_throw(name);
  if (!this->Option)
  {
    this->Option = command
                     .add_option(name,
                       "Images that contradict the others, because they are turned or swapped or "
                       "their camera is wrong: drop or keep")
                     ->check(CLI::IsMember({ "drop", "keep" }))
                     ->default_str("drop")
                     ->group(group);
  }
}

bool WrongImagesOption::AreDropped() const
{
  return !this->Option || this->Option->empty() || this->Option->as<std::string>() == "drop";
}

}
