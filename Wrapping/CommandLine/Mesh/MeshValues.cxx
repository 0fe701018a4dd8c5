// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshValues.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Files/PathChecks.h"
#include "Session/NumberValidators.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

namespace freespace
{

namespace
{

constexpr int LargestCount = 2000000000;

}

std::array<double, 16> ReadMatrix(const std::string& fileName)
{
  std::ifstream file(fileName);
  if (!file || IsFolder(fileName))
  {
    throw Error("'" + fileName + "' cannot be read.");
  }
  std::vector<double> numbers;
  std::string word;
  word.reserve(64);
  for (char c = 0; numbers.size() <= 16 && word.size() < 64 && file.get(c);)
  {
    const bool isBlank = c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
    word += isBlank ? "" : std::string(1, c);
    if (!word.empty() && (isBlank || file.peek() == std::ifstream::traits_type::eof()))
    {
      const std::optional<double> number = ParseNumber<double>(word);
      numbers.push_back(number.value_or(std::nan("")));
      word.clear();
    }
  }
  const bool areFinite =
    std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
  if (numbers.size() != 16 || !areFinite || !word.empty())
  {
    throw Error("'" + fileName + "' is no matrix of 4 x 4 numbers.");
  }
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers.data());
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1) ||
    !(std::abs(matrix.topLeftCorner<3, 3>().determinant()) > 0))
  {
    throw Error("'" + fileName +
      "' is no affine transformation: its last row must be 0 0 0 1, "
      "and it must not be flat.");
  }
  std::array<double, 16> values;
  std::copy(numbers.begin(), numbers.end(), values.begin());
  return values;
}

std::string BoxFault(const std::string& text)
{
  const std::vector<double> b = NumbersOf(text);
  const bool isBox = b.size() == 6 && b[0] < b[1] && b[2] < b[3] && b[4] < b[5];
  return isBox ? "" : "'" + text + "' is no box x0,x1,y0,y1,z0,z1, each lower than its upper";
}

std::string VectorFault(const std::string& text)
{
  return NumbersOf(text).size() == 3 ? "" : "'" + text + "' is no vector x,y,z";
}

std::string NumberFault(const std::string& text)
{
  const std::vector<double> numbers = NumbersOf(text);
  return numbers.size() == 1 && numbers[0] > 0 ? "" : "'" + text + "' is not a number above 0";
}

std::string CountFault(const std::string& text)
{
  const std::optional<int> count = ParseNumber<int>(text);
  return count && *count >= 1 && *count <= LargestCount ? ""
                                                        : "'" + text + "' is no count of 1 or more";
}

std::string AnyFault(const std::string&)
{
  return "";
}

}
