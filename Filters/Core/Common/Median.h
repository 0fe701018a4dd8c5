// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Median_h
#define freespace_Median_h

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace freespace
{

/// The median of at least one value: the one of rank n / 2, hence the upper of the middle two where
/// n is even. O(n).
template <typename Value>
Value Median(std::vector<Value> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The same; `without` where there are no values.
template <typename Value>
Value MedianOr(std::vector<Value> values, Value without)
{
  return values.empty() ? without : Median(std::move(values));
}

}

#endif
