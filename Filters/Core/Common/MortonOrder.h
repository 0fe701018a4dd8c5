// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MortonOrder_h
#define freespace_MortonOrder_h

#include <cstdint>
#include <vector>

namespace freespace
{

/// The place of a cell along the Z-order curve (Morton 1966), on which cells that follow each other are mostly
/// close to each other: the bits of the coordinates in turn, those of x the lowest. Less than 2^32 and 2^63.
std::uint64_t MortonKey(std::uint16_t x, std::uint16_t y);
std::uint64_t MortonKey(
  std::uint32_t x, std::uint32_t y, std::uint32_t z); ///< their lowest 21 bits

/// An index that is sorted by a key.
struct KeyedIndex
{
  std::uint64_t key;
  int index;
};

/// Sorts by the keys, which are below 2^keyBits; equal ones keep their order. O(n keyBits).
void SortByKey(std::vector<KeyedIndex>& items, int keyBits);

}

#endif
