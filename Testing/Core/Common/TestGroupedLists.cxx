// SPDX-License-Identifier: BSD-3-Clause
#include "Common/GroupedLists.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

using namespace freespace;

namespace
{

using Pairs = std::vector<std::pair<std::size_t, int>>;

GroupedLists<int> Group(std::size_t keys, const Pairs& pairs)
{
  return GroupedLists<int>(keys,
    [&pairs](const auto& add)
    {
      for (const auto& [key, value] : pairs)
      {
        add(key, value);
      }
    });
}

// Values 0, 1, ... with random keys.
Pairs RandomPairs(std::mt19937& random, std::size_t keys, std::size_t count)
{
  Pairs pairs;
  for (std::size_t i = 0; i < count; ++i)
  {
    pairs.emplace_back(random() % keys, static_cast<int>(i));
  }
  return pairs;
}

void ExpectLists(const GroupedLists<int>& lists, const std::vector<std::vector<int>>& truth)
{
  ASSERT_EQ(lists.NumberOfKeys(), truth.size());
  std::vector<int> all;
  for (std::size_t key = 0; key < truth.size(); ++key)
  {
    const auto list = lists[key];
    ASSERT_EQ(std::vector<int>(list.begin(), list.end()), truth[key]) << "key " << key;
    ASSERT_EQ(list.size(), truth[key].size());
    all.insert(all.end(), truth[key].begin(), truth[key].end());
  }
  EXPECT_EQ(lists.AllValues(), all);
  const auto whole = lists.Between(0, truth.size());
  EXPECT_EQ(std::vector<int>(whole.begin(), whole.end()), all);
}

}

TEST(GroupedLists, AgreesWithAVectorPerKey)
{
  std::mt19937 random(1);
  for (const std::size_t keys : { 1, 3, 50 })
  {
    for (const std::size_t count : { 0, 1, 20, 400 })
    {
      const Pairs pairs = RandomPairs(random, keys, count);
      std::vector<std::vector<int>> truth(keys);
      for (const auto& [key, value] : pairs)
      {
        truth[key].push_back(value);
      }
      ExpectLists(Group(keys, pairs), truth);
    }
  }
}

TEST(GroupedLists, FilterKeepsTheOrderOfWhatItKeeps)
{
  std::mt19937 random(2);
  const Pairs pairs = RandomPairs(random, 20, 300);
  std::vector<std::vector<int>> truth(20);
  for (const auto& [key, value] : pairs)
  {
    if ((key + value) % 3 == 0)
    {
      truth[key].push_back(value);
    }
  }
  GroupedLists<int> lists = Group(20, pairs);
  lists.Filter([](std::size_t key, int value) { return (key + value) % 3 == 0; });
  ExpectLists(lists, truth);
  lists.Filter([](std::size_t, int) { return false; });
  ExpectLists(lists, std::vector<std::vector<int>>(20));
}

TEST(GroupedLists, SortsEachListAlone)
{
  std::mt19937 random(3);
  const Pairs pairs = RandomPairs(random, 20, 300);
  std::vector<std::vector<int>> truth(20);
  for (const auto& [key, value] : pairs)
  {
    truth[key].insert(truth[key].begin(), value);
  }
  GroupedLists<int> lists = Group(20, pairs);
  lists.SortLists([](int a, int b) { return a > b; });
  ExpectLists(lists, truth);
}

TEST(GroupedLists, BeginsAreSumsOfCounts)
{
  const std::vector<std::size_t> keys = { 3, 1, 3, 0, 3 };
  const auto visit = [&keys](const auto& add)
  {
    for (const std::size_t key : keys)
    {
      add(key);
    }
  };
  EXPECT_EQ(BeginOfLists<int>(5, visit), (std::vector<int>{ 0, 1, 2, 2, 5, 5 }));
  EXPECT_EQ(BeginOfLists<int>(0, [](const auto&) {}), std::vector<int>{ 0 });
}

TEST(GroupedLists, WithoutKeysOrValues)
{
  EXPECT_EQ(GroupedLists<int>().NumberOfKeys(), 0u);
  EXPECT_EQ(Group(0, {}).NumberOfKeys(), 0u);
  ExpectLists(Group(4, {}), std::vector<std::vector<int>>(4));
}
