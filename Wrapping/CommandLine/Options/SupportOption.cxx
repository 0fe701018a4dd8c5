// SPDX-License-Identifier: BSD-3-Clause
#include "Options/SupportOption.h"

#include "Disparity/Outliers/OutlierOptions.h"

namespace freespace
{

namespace
{

CLI::Option* AddCount(CLI::App& command, const std::string& group, const std::string& name,
  const std::string& help, int standard)
{
  CLI::Option* known = command.get_option_no_throw(name);
  return known ? known
               : command.add_option(name, help)
                   ->type_name("INT")
                   ->check(CLI::Range(0, 1000000))
                   ->default_str(std::to_string(standard))
                   ->group(group);
}

int CountOf(const CLI::Option* option, int standard)
{
  return option && !option->empty() ? option->as<int>() : standard;
}

}

void SupportOption::AddTo(CLI::App& command, const std::string& group)
{
  const OutlierOptions standard;
  this->Least = AddCount(command, group, "--support",
    "Minimum number of neighbours of a feature with a similar depth; one with fewer is an outlier; "
    "0 keeps all",
    standard.support);
  this->Sharing = AddCount(command, group, "--sharing-views",
    "A feature that this number of views share needs no support, such as the points of a "
    "structure-from-motion model; 0: all need it",
    standard.sharingViews);
}

int SupportOption::Support() const
{
  return CountOf(this->Least, OutlierOptions().support);
}

int SupportOption::SharingViews() const
{
  return CountOf(this->Sharing, OutlierOptions().sharingViews);
}

}
