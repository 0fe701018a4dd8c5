// SPDX-License-Identifier: BSD-3-Clause
#include "Options/UnionOptions.h"

#include "Common/ParseNumber.h"
#include "Session/NumberValidators.h"

namespace freespace
{

void UnionOptions::AddTo(CLI::App& command, const std::string& group)
{
  this->Region.AddTo(command, group);
  command
    .add_option("--hull-margin", this->HullMargin,
      "Offset of the hull of the features to the outside, as a fraction of its diagonal; 0 in the "
      "paper; default: slightly more than a lattice cell, "
      "or than the distance of the features where they are sparse")
    ->check(Between(0.0, 10.0))
    ->group(group);
  command
    .add_option("--min-views", this->MinimumViews,
      "Number of views that must see a point as free; auto: 3, or no fewer than "
      "contradict them, which have it closely behind their own surface; 1 in the paper")
    ->check(CLI::IsMember({ "auto" }) | WholeNumber(1, 1000000))
    ->type_name("auto|INT")
    ->capture_default_str()
    ->group(group);
  command
    .add_option("--contradiction", this->Contradiction,
      "How far behind its surface a view contradicts others (--min-views auto), in distances of "
      "its features")
    ->check(Positive())
    ->capture_default_str()
    ->group(group);
}

double UnionOptions::MarginFor(int cells) const
{
  return this->HullMargin >= 0 ? this->HullMargin : FreespaceUnionOptions::MarginOfLattice(cells);
}

int UnionOptions::Views() const
{
  return ParseNumber<int>(this->MinimumViews).value_or(FreespaceUnionOptions::AutomaticViews);
}

}
