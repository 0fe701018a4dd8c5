// SPDX-License-Identifier: BSD-3-Clause
#include "Common/MortonOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace freespace;

namespace
{

// The bits of the coordinates in turn, one after the other.
template <typename Coordinates>
std::uint64_t ByBits(const Coordinates& coordinates, int bits)
{
  std::uint64_t key = 0;
  int place = 0;
  for (int bit = 0; bit < bits; ++bit)
  {
    for (const std::uint64_t coordinate : coordinates)
    {
      key |= (coordinate >> bit & 1) << place++;
    }
  }
  return key;
}

std::vector<int> IndicesOf(const std::vector<KeyedIndex>& items)
{
  std::vector<int> indices;
  for (const KeyedIndex& item : items)
  {
    indices.push_back(item.index);
  }
  return indices;
}

}

TEST(MortonOrder, TheFirstCellsAreLetterZs)
{
  EXPECT_EQ(MortonKey(0, 0), 0u);
  EXPECT_EQ(MortonKey(1, 0), 1u);
  EXPECT_EQ(MortonKey(0, 1), 2u);
  EXPECT_EQ(MortonKey(1, 1), 3u);
  EXPECT_EQ(MortonKey(2, 0), 4u);
  EXPECT_EQ(MortonKey(0, 0, 1), 4u);
  EXPECT_EQ(MortonKey(1, 1, 1), 7u);
  EXPECT_EQ(MortonKey(2, 0, 0), 8u);
}

TEST(MortonOrder, TheLastCells)
{
  EXPECT_EQ(MortonKey(0xffff, 0xffff), 0xffffffffu);
  EXPECT_EQ(MortonKey(0x1fffff, 0x1fffff, 0x1fffff), 0x7fffffffffffffffu);
  EXPECT_EQ(MortonKey(0xffe00000, 0, 0), 0u) << "bits above the lowest 21 are ignored";
}

TEST(MortonOrder, TheBitsAreInTurn)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<std::uint32_t> small(0, 0xffff), large(0, 0x1fffff);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const std::array<std::uint32_t, 2> pixel = { small(random), small(random) };
    const std::array<std::uint32_t, 3> cell = { large(random), large(random), large(random) };
    EXPECT_EQ(MortonKey(static_cast<std::uint16_t>(pixel[0]), static_cast<std::uint16_t>(pixel[1])),
      ByBits(pixel, 16));
    EXPECT_EQ(MortonKey(cell[0], cell[1], cell[2]), ByBits(cell, 21));
  }
}

TEST(MortonOrder, NothingIsSorted)
{
  std::vector<KeyedIndex> items;
  SortByKey(items, 32);
  EXPECT_TRUE(items.empty());
  items = { { 5, 7 } };
  SortByKey(items, 32);
  EXPECT_EQ(IndicesOf(items), std::vector<int>{ 7 });
}

TEST(MortonOrder, SortsAsAStableSort)
{
  std::mt19937_64 random(5);
  for (const int bits : { 1, 10, 11, 12, 32, 63, 64 })
  {
    for (const int distinct : { 3, 100000 })
    {
      std::vector<std::uint64_t> keys;
      for (int i = 0; i < distinct; ++i)
      {
        keys.push_back(random() >> (64 - bits));
      }
      std::vector<KeyedIndex> items;
      for (int i = 0; i < 2000; ++i)
      {
        items.push_back({ keys[random() % keys.size()], i });
      }
      std::vector<KeyedIndex> expected = items;
      std::stable_sort(expected.begin(), expected.end(),
        [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
      SortByKey(items, bits);
      EXPECT_EQ(IndicesOf(items), IndicesOf(expected)) << bits << " bits";
    }
  }
}
