// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RandomValues_h
#define freespace_RandomValues_h

#include <algorithm>
#include <random>
#include <vector>

namespace freespace
{

/// Vectors of random numbers, for what is done for many at once.
class RandomValues
{
public:
  explicit RandomValues(unsigned seed)
    : Generator(seed)
  {
  }

  template <typename T>
  std::vector<T> Next(int count, double low, double high)
  {
    std::uniform_real_distribution<double> uniform(low, high);
    std::vector<T> values(count);
    std::generate(
      values.begin(), values.end(), [&]() { return static_cast<T>(uniform(this->Generator)); });
    return values;
  }

private:
  std::mt19937 Generator;
};

/// Lengths that no register divides, and some that one does.
constexpr int Widths[] = { 3, 4, 7, 8, 9, 31, 32, 33, 100, 257 };

}

#endif
