// SPDX-License-Identifier: BSD-3-Clause
#include "Options/GlobalShiftOption.h"

#include "Files/GlobalShift.h"
#include "Session/NumberValidators.h"

#include <algorithm>
#include <vector>

namespace freespace
{

namespace
{

// "X,Y,Z"; false where the text is anything else.
bool ReadShift(const std::string& text, Eigen::Vector3d& shift)
{
  const std::vector<double> numbers = NumbersOf(text);
  std::copy_n(numbers.begin(), std::min<std::size_t>(numbers.size(), 3), shift.data());
  return numbers.size() == 3;
}

std::string Fault(const std::string& text)
{
  Eigen::Vector3d shift;
  return text == "none" || text == "auto" || ReadShift(text, shift)
    ? ""
    : "'" + text + "' is no global shift: it is none, auto or X,Y,Z.";
}

}

void GlobalShiftOption::AddTo(CLI::App& command, const std::string& group)
{
  command
    .add_option("--global-shift", this->Shift,
      "Subtract X,Y,Z from the coordinates in the file, which tells them, so that they are added "
      "when it is "
      "read again; auto: what a scene far from the origin needs to be kept in single precision")
    ->check(CLI::Validator(Fault, ""))
    ->type_name("none|auto|X,Y,Z")
    ->capture_default_str()
    ->group(group);
}

Eigen::Vector3d GlobalShiftOption::For(const Eigen::AlignedBox3d& box) const
{
  if (this->IsAutomatic())
  {
    return SuggestGlobalShift(box);
  }
  Eigen::Vector3d shift;
  return ReadShift(this->Shift, shift) ? shift : Eigen::Vector3d::Zero();
}

}
