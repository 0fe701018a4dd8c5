// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GlobalShiftOption_h
#define freespace_GlobalShiftOption_h

#include <CLI/CLI.hpp>

#include <Eigen/Geometry>

#include <string>

namespace freespace
{

/// --global-shift: what is subtracted from the coordinates of a file that is written.
class GlobalShiftOption
{
public:
  void AddTo(CLI::App& command, const std::string& group = "Options");

  bool IsAutomatic() const { return this->Shift == "auto"; }

  /// Of what is in the box.
  Eigen::Vector3d For(const Eigen::AlignedBox3d& box) const;

private:
  std::string Shift = "none";
};

}

#endif
