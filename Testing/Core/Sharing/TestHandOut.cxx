// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/HandOut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>

using namespace freespace;

namespace
{

using ItemList = std::vector<std::size_t>;

SharedLoop LoopOf(const std::vector<double>& work)
{
  SharedLoop loop;
  loop.work = work;
  return loop;
}

MadeItem MadeOf(std::size_t item, bool hasFailed = false)
{
  return { item, hasFailed, "value " + std::to_string(item) };
}

}

TEST(HandOut, TheMostWorkIsGivenFirst)
{
  const SharedLoop loop = LoopOf({ 1, 5, 3, 5, 2 });
  HandOut handOut(loop, 2);
  EXPECT_TRUE(handOut.HasItems());
  EXPECT_EQ(handOut.Give(0, 2), (ItemList{ 1, 3 }));
  EXPECT_EQ(handOut.Give(1, 1), (ItemList{ 2 }));
  EXPECT_EQ(handOut.Give(1, 7), (ItemList{ 4, 0 }));
  EXPECT_FALSE(handOut.HasItems());
  EXPECT_TRUE(handOut.Give(0, 1).empty());
}

TEST(HandOut, NeighboursThatAreAlikeStayTogether)
{
  SharedLoop loop = LoopOf(std::vector<double>(9, 1.0));
  loop.areNeighborsAlike = true;
  HandOut handOut(loop, 3);
  EXPECT_EQ(handOut.Give(0, 2), (ItemList{ 0, 1 }));
  EXPECT_EQ(handOut.Give(1, 2), (ItemList{ 3, 4 }));
  EXPECT_EQ(handOut.Give(2, 4), (ItemList{ 6, 7, 8, 2 }))
    << "from its end on to what is left at the beginning";
  EXPECT_EQ(handOut.Give(0, 4), (ItemList{ 5 }));
}

TEST(HandOut, FractionIsThatOfTheWork)
{
  const SharedLoop loop = LoopOf({ 6, 3, 1 });
  HandOut handOut(loop, 1);
  EXPECT_TRUE(handOut.IsIdle(0));
  handOut.Give(0, 3);
  EXPECT_FALSE(handOut.IsIdle(0));
  EXPECT_DOUBLE_EQ(handOut.Fraction(), 0);
  handOut.Accept(0, { MadeOf(0) });
  EXPECT_DOUBLE_EQ(handOut.Fraction(), 0.6);
  handOut.Accept(0, { MadeOf(1), MadeOf(2) });
  EXPECT_DOUBLE_EQ(handOut.Fraction(), 1);
  EXPECT_TRUE(handOut.IsIdle(0));
}

// After a failure only what comes before it is given: the first failure is that of a single process.
TEST(HandOut, TheFirstFailureCounts)
{
  const SharedLoop loop = LoopOf(std::vector<double>(6, 1.0));
  HandOut handOut(loop, 2);
  EXPECT_EQ(handOut.Failed(), nullptr);
  EXPECT_EQ(handOut.Give(0, 1), (ItemList{ 0 }));
  EXPECT_EQ(handOut.Give(1, 2), (ItemList{ 1, 2 }));
  handOut.Accept(1, { MadeOf(2, true) });
  ASSERT_NE(handOut.Failed(), nullptr);
  EXPECT_EQ(handOut.Failed()->item, 2u);
  EXPECT_FALSE(handOut.HasItems()) << "3, 4 and 5 come later";
  EXPECT_TRUE(handOut.Give(0, 6).empty());
  handOut.Accept(1, { MadeOf(1, true) });
  EXPECT_EQ(handOut.Failed()->item, 1u);
  handOut.Accept(0, { MadeOf(0) });
  EXPECT_EQ(handOut.Failed()->item, 1u);
}

TEST(HandOut, WhatComesBeforeAFailureIsStillMade)
{
  const SharedLoop loop = LoopOf({ 1, 1, 9, 1 }); // item 2 is begun first
  HandOut handOut(loop, 1);
  EXPECT_EQ(handOut.Give(0, 1), (ItemList{ 2 }));
  handOut.Accept(0, { MadeOf(2, true) });
  EXPECT_TRUE(handOut.HasItems());
  EXPECT_EQ(handOut.Give(0, 9), (ItemList{ 0, 1 }));
}

TEST(HandOut, ALaterFailureDoesNotCount)
{
  const SharedLoop loop = LoopOf({ 1, 1, 1 });
  HandOut handOut(loop, 1);
  handOut.Give(0, 3);
  handOut.Accept(0, { MadeOf(1, true), MadeOf(2, true) });
  ASSERT_NE(handOut.Failed(), nullptr);
  EXPECT_EQ(handOut.Failed()->item, 1u);
}

TEST(HandOut, NoItemsAreDone)
{
  const SharedLoop loop = LoopOf({});
  HandOut handOut(loop, 3);
  EXPECT_FALSE(handOut.HasItems());
  EXPECT_TRUE(handOut.Give(1, 1).empty());
  EXPECT_EQ(handOut.Failed(), nullptr);
  EXPECT_TRUE(handOut.MadeByOthers(0).empty());
}

// Whatever the order in which processes ask and answer: each item is made once, and each process is told of
// exactly those that it has not made.
TEST(HandOut, EachItemIsMadeOnceAndToldToTheOthers)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial)
  {
    const int processes = 1 + static_cast<int>(random() % 5);
    SharedLoop loop;
    loop.areNeighborsAlike = trial % 2 == 0;
    for (std::size_t i = random() % 60; i > 0; --i)
    {
      loop.work.push_back(1.0 + static_cast<double>(random() % 4));
    }
    HandOut handOut(loop, processes);
    std::vector<ItemList> waiting(processes), made(processes);
    std::set<std::size_t> given;
    while (handOut.Fraction() < 1 - 1e-12 && !loop.work.empty())
    {
      const int process = static_cast<int>(random() % processes);
      ItemList& items = waiting[process];
      if (items.empty())
      {
        items = handOut.Give(process, 1 + static_cast<int>(random() % 3));
        for (const std::size_t item : items)
        {
          EXPECT_TRUE(given.insert(item).second) << item;
        }
      }
      else
      {
        handOut.Accept(process, { MadeOf(items.back()) });
        made[process].push_back(items.back());
        items.pop_back();
      }
      EXPECT_EQ(handOut.IsIdle(process), items.empty());
    }
    EXPECT_EQ(given.size(), loop.work.size());
    for (int process = 0; process < processes; ++process)
    {
      ItemList all = made[process];
      for (const MadeItem& other : handOut.MadeByOthers(process))
      {
        EXPECT_EQ(other.bytes, "value " + std::to_string(other.item));
        all.push_back(other.item);
      }
      std::sort(all.begin(), all.end());
      ItemList expected(loop.work.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        expected[i] = i;
      }
      EXPECT_EQ(all, expected);
    }
  }
}
