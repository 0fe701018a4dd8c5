// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RegionOption_h
#define freespace_RegionOption_h

#include <CLI/CLI.hpp>

#include <array>
#include <string>

class vtkFreespaceUnion;

namespace freespace
{

/// --region: what of the scene is reconstructed.
class RegionOption
{
public:
  void AddTo(CLI::App& command, const std::string& group = "Options");

  /// Sets it on a vtkFreespaceUnion, or what has the same methods for it.
  template <typename Target>
  void SetUp(Target* target) const
  {
    std::array<double, 6> bounds{};
    if (this->Region == "all")
    {
      target->SetRegionModeToWhole();
    }
    else if (ReadBounds(this->Region, bounds))
    {
      target->SetRegion(bounds.data());
    }
  }

  /// What was found, in words: "region 9.1 x 4 x 3.2; 0.4% of the features lie beyond it ...".
  static std::string Found(vtkFreespaceUnion* phi);

private:
  static bool ReadBounds(const std::string& text, std::array<double, 6>& bounds);
  static std::string Fault(const std::string& text);

  std::string Region = "auto";
};

}

#endif
