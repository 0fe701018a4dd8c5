// SPDX-License-Identifier: BSD-3-Clause
#include "Options/RegionOption.h"

#include "Session/NumberValidators.h"

#include <vtkFreespaceUnion.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace freespace
{

// "x0,x1,y0,y1,z0,z1" -> the bounds; false where it is anything else.
bool RegionOption::ReadBounds(const std::string& text, std::array<double, 6>& b)
{
  const std::vector<double> numbers = NumbersOf(text);
  if (numbers.size() != b.size())
  {
    return false;
  }
  std::copy(numbers.begin(), numbers.end(), b.begin());
  return b[0] < b[1] && b[2] < b[3] && b[4] < b[5];
}

std::string RegionOption::Fault(const std::string& text)
{
  std::array<double, 6> bounds{};
  return text == "auto" || text == "all" || ReadBounds(text, bounds) ? ""
                                                                     : "'" + text +
      "' is no region: it is auto, all, or x0,x1,y0,y1,z0,z1, each lower than its upper.";
}

void RegionOption::AddTo(CLI::App& command, const std::string& group)
{
  command
    .add_option("--region", this->Region,
      "Region of interest, whose features define the hull and the lattice: the box "
      "x0,x1,y0,y1,z0,z1, all, or (auto) all without distant ones; features beyond still claim "
      "free space")
    ->check(CLI::Validator(Fault, ""))
    ->type_name("auto|all|BOX")
    ->capture_default_str()
    ->group(group);
}

std::string RegionOption::Found(vtkFreespaceUnion* phi)
{
  double b[6];
  phi->GetRegionBounds(b);
  std::ostringstream line;
  line.precision(3);
  line << "region " << b[1] - b[0] << " x " << b[3] - b[2] << " x " << b[5] - b[4];
  const auto beyond = phi->GetNumberOfFeaturesBeyond();
  if (beyond == 0)
  {
    line << " with all features";
    return line.str();
  }
  line.precision(2);
  line << "; " << 100.0 * beyond / phi->GetNumberOfFeatures()
       << "% of the features lie beyond it: --region all keeps them";
  return line.str();
}

}
