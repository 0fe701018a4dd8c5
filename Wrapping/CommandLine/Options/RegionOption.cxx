// SPDX-License-Identifier: BSD-3-Clause
#include "Options/RegionOption.h"

#include "Common/ParseNumber.h"

#include <vtkFreespaceUnion.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

namespace freespace
{

// "x0,x1,y0,y1,z0,z1" -> the bounds; false where it is anything else.
bool RegionOption::ReadBounds(const std::string& text, std::array<double, 6>& b)
{
  std::string_view rest = text;
  bool isBox = true;
  for (std::size_t i = 0; i < b.size() && isBox; ++i)
  {
    const std::size_t comma = rest.find(',');
    std::string_view number = rest.substr(0, comma);
    number.remove_prefix(std::min(number.find_first_not_of(' '), number.size()));
    const std::optional<double> bound = ParseNumber<double>(number);
    isBox = bound && (comma == std::string_view::npos) == (i + 1 == b.size());
    b[i] = bound.value_or(0);
    rest.remove_prefix(std::min(comma, rest.size() - 1) + 1);
  }
  for (int axis = 0; axis < 3 && isBox; ++axis)
  {
    isBox =
      std::isfinite(b[2 * axis]) && std::isfinite(b[2 * axis + 1]) && b[2 * axis] < b[2 * axis + 1];
  }
  return isBox;
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
