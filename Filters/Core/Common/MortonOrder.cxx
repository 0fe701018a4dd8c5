// SPDX-License-Identifier: BSD-3-Clause
#include "Common/MortonOrder.h"

#include <array>
#include <cstddef>
#include <numeric>

namespace freespace
{

namespace
{

// The 16 lowest bits of a number, each followed by a zero.
std::uint64_t SpreadByOne(std::uint64_t bits)
{
  bits = (bits | bits << 8) & 0x00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f;
  bits = (bits | bits << 2) & 0x33333333;
  return (bits | bits << 1) & 0x55555555;
}

// The 21 lowest bits of a number, each followed by two zeros.
std::uint64_t SpreadByTwo(std::uint64_t bits)
{
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

}

std::uint64_t MortonKey(std::uint16_t x, std::uint16_t y)
{
  return SpreadByOne(x) | SpreadByOne(y) << 1;
}

std::uint64_t MortonKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  return SpreadByTwo(x) | SpreadByTwo(y) << 1 | SpreadByTwo(z) << 2;
}

// A radix sort from the least significant digit.
void SortByKey(std::vector<KeyedIndex>& items, int keyBits)
{
  constexpr int digitBits = 11;
  constexpr std::size_t digits = std::size_t(1) << digitBits;
  std::vector<KeyedIndex> sorted(items.size());
  for (int shift = 0; shift < keyBits; shift += digitBits)
  {
    const auto digit = [shift](const KeyedIndex& item)
    { return (item.key >> shift) & (digits - 1); };
    std::array<std::size_t, digits + 1> begin = {};
    for (const KeyedIndex& item : items)
    {
      ++begin[digit(item) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const KeyedIndex& item : items)
    {
      sorted[begin[digit(item)]++] = item;
    }
    items.swap(sorted);
  }
}

}
