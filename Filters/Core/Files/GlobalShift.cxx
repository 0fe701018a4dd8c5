// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GlobalShift.h"

#include "Common/ParseNumber.h"

#include <array>
#include <cmath>
#include <limits>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

constexpr std::string_view Words = "global shift";

}

bool SufficesSingle(const Eigen::AlignedBox3d& box)
{
  if (box.isEmpty())
  {
    return true;
  }
  constexpr double mostRounding = 1e-5; // of the diagonal
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return largest <= std::numeric_limits<float>::max() &&
    largest * std::numeric_limits<float>::epsilon() / 2 <= mostRounding * box.diagonal().norm();
}

Vector3d SuggestGlobalShift(const Eigen::AlignedBox3d& box)
{
  if (SufficesSingle(box))
  {
    return Vector3d::Zero();
  }
  const double diagonal = box.diagonal().norm();
  // A single place has no diagonal: metres are fine enough.
  const double unit = diagonal > 0 ? std::pow(10.0, std::ceil(std::log10(diagonal))) : 1.0;
  return (box.center() / unit).array().round() * unit;
}

std::string GlobalShiftComment(const Vector3d& shift)
{
  if (shift.isZero(0))
  {
    return "";
  }
  std::string text(Words);
  for (const double coordinate : shift)
  {
    std::array<char, 1100> digits; // of the longest double that there is
    const auto [end, code] = std::to_chars(
      digits.data(), digits.data() + digits.size(), coordinate, std::chars_format::fixed);
    text += " " + std::string(digits.data(), end);
  }
  return text;
}

std::optional<Vector3d> GlobalShiftFromComment(std::string_view comment)
{
  if (comment.substr(0, Words.size()) != Words)
  {
    return std::nullopt;
  }
  comment.remove_prefix(Words.size());
  Vector3d shift;
  for (double& coordinate : shift)
  {
    const std::size_t begin = comment.find_first_not_of(' ');
    if (begin == 0 || begin == std::string_view::npos)
    {
      return std::nullopt;
    }
    comment.remove_prefix(begin);
    const std::size_t end = std::min(comment.find(' '), comment.size());
    const auto number = ParseNumber<double>(comment.substr(0, end));
    if (!number || !std::isfinite(*number))
    {
      return std::nullopt;
    }
    coordinate = *number;
    comment.remove_prefix(end);
  }
  const bool isAll = comment.find_first_not_of(' ') == std::string_view::npos;
  return isAll ? std::optional<Vector3d>(shift) : std::nullopt;
}

}
