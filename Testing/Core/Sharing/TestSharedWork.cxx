// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/MakeAll.h"
#include "Sharing/SharedWork.h"
#include "Sharing/ViewBytes.h"

#include "Support/Core/TwoThreads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace freespace
{

namespace
{

// Processes that are threads of this one.
class Mailboxes
{
public:
  explicit Mailboxes(int count)
    : Boxes(count)
  {
  }

  class Member : public ProcessMessages
  {
  public:
    Member(Mailboxes& all, int rank)
      : All(all)
      , Own(rank)
    {
    }
    int Rank() const override { return this->Own; }
    int Count() const override { return static_cast<int>(this->All.Boxes.size()); }

    void Send(int to, const std::string& message) override
    {
      const std::lock_guard<std::mutex> lock(this->All.Mutex);
      this->All.Boxes[to].emplace_back(this->Own, message);
    }

    bool Receive(int& from, std::string& message) override
    {
      const std::lock_guard<std::mutex> lock(this->All.Mutex);
      auto& box = this->All.Boxes[this->Own];
      if (box.empty())
      {
        return false;
      }
      std::tie(from, message) = std::move(box.front());
      box.pop_front();
      return true;
    }

  private:
    Mailboxes& All;
    int Own;
  };

private:
  std::mutex Mutex;
  std::vector<std::deque<std::pair<int, std::string>>> Boxes;
};

using Work = std::function<void(int rank, SharedWork& shared)>;

// Runs work together in so many processes; what each of them says of its failure.
std::vector<std::string> RunTogether(int count, const Work& work)
{
  Mailboxes boxes(count);
  std::vector<std::string> ends(count);
  std::vector<std::thread> processes;
  for (int rank = 0; rank < count; ++rank)
  {
    processes.emplace_back(
      [&, rank]
      {
        Mailboxes::Member member(boxes, rank);
        SharedWork shared(member);
        try
        {
          shared.Together([&] { work(rank, shared); });
        }
        catch (const std::exception& error)
        {
          ends[rank] = error.what();
        }
      });
  }
  for (std::thread& process : processes)
  {
    process.join();
  }
  return ends;
}

std::vector<std::string> AllOf(int count, const std::string& sentence)
{
  return std::vector<std::string>(count, sentence);
}

std::vector<int> Squares(
  std::size_t count, const ParallelFor& parallelFor,
  const std::function<void(std::size_t)>& also = [](std::size_t) {})
{
  return MakeAll<int>(count, parallelFor, {},
    [&](std::size_t i, const CancellationFlag&)
    {
      also(i);
      return static_cast<int>(i * i);
    });
}

}

TEST(SharedWork, AllHaveWhatEachHasMade)
{
  const std::vector<int> expected = Squares(100, SerialFor);
  for (const int count : { 1, 2, 3, 7 })
  {
    std::atomic<int> made{ 0 };
    std::vector<std::vector<int>> first(count), second(count);
    std::vector<std::uint64_t> exchanged(count);
    const auto ends = RunTogether(count,
      [&](int rank, SharedWork& shared)
      {
        first[rank] = Squares(100, { TwoThreads, &shared }, [&](std::size_t) { ++made; });
        second[rank] = Squares(2, { TwoThreads, &shared });
        Squares(0, { TwoThreads, &shared });
        exchanged[rank] = shared.BytesExchanged();
      });
    // All of it goes through the first process.
    EXPECT_EQ(
      exchanged[0], std::accumulate(exchanged.begin() + 1, exchanged.end(), std::uint64_t(0)));
    EXPECT_EQ(exchanged[0] > 0, count > 1);
    EXPECT_EQ(ends, AllOf(count, ""));
    EXPECT_EQ(made, 100);
    for (int rank = 0; rank < count; ++rank)
    {
      EXPECT_EQ(first[rank], expected);
      EXPECT_EQ(second[rank], (std::vector<int>{ 0, 1 }));
    }
  }
}

TEST(SharedWork, TheFirstItemThatFailsIsTold)
{
  const auto ends = RunTogether(3,
    [](int, SharedWork& shared)
    {
      Squares(50, { TwoThreads, &shared },
        [](std::size_t i)
        {
          if (i % 10 == 7)
          {
            throw Error("Item " + std::to_string(i) + ".");
          }
        });
    });
  EXPECT_EQ(ends, AllOf(3, "Item 7."));
}

TEST(SharedWork, AFailureOfOneEndsAll)
{
  for (int failing = 0; failing < 3; ++failing)
  {
    const auto fail = [failing](int rank)
    {
      if (rank == failing)
      {
        throw Error("One has failed.");
      }
    };
    const auto before = RunTogether(3,
      [&](int rank, SharedWork& shared)
      {
        fail(rank);
        Squares(20, { SerialFor, &shared });
      });
    const auto after = RunTogether(3,
      [&](int rank, SharedWork& shared)
      {
        Squares(20, { SerialFor, &shared });
        fail(rank);
      });
    EXPECT_EQ(before, AllOf(3, "One has failed."));
    EXPECT_EQ(after, AllOf(3, "One has failed."));
  }
}

TEST(SharedWork, NobodyGoesOnWhenOneHasFailed)
{
  for (int failing = -1; failing < 3; ++failing)
  {
    std::atomic<int> gone{ 0 };
    std::vector<std::string> notes;
    const auto ends = RunTogether(3,
      [&](int rank, SharedWork& shared)
      {
        if (rank == failing)
        {
          throw Error("One has failed.");
        }
        const auto told = shared.Agree({ "Note of " + std::to_string(rank) });
        ++gone;
        if (rank == 0)
        {
          notes = told;
        }
        Squares(20, { SerialFor, &shared });
      });
    EXPECT_EQ(ends, AllOf(3, failing < 0 ? "" : "One has failed."));
    EXPECT_EQ(gone, failing < 0 ? 3 : 0);
    EXPECT_EQ(notes.size(), failing < 0 ? 2u : 0u);
  }
}

TEST(SharedWork, ARequestToStopCountsMoreThanAFailure)
{
  const auto ends = RunTogether(3,
    [](int rank, SharedWork& shared)
    {
      const Progress progress([rank](double) { return rank != 2; });
      MakeAll<int>(20, { SerialFor, &shared }, progress,
        [](std::size_t, const CancellationFlag& stop)
        {
          while (!stop)
          {
            std::this_thread::yield();
          }
          return 0;
        });
    });
  EXPECT_EQ(ends, AllOf(3, Aborted().what()));
}

TEST(SharedWork, ProcessesThatDoNotDoTheSameEnd)
{
  const auto ends = RunTogether(2,
    [](int rank, SharedWork& shared) {
      Squares(rank == 0 ? 5 : 6, { SerialFor, &shared });
    });
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_NE(ends[0].find("different"), std::string::npos);
  for (const int one : { 0, 1 })
  {
    const auto loopOfOne = RunTogether(2,
      [one](int rank, SharedWork& shared)
      {
        if (rank == one)
        {
          Squares(5, { SerialFor, &shared });
        }
      });
    EXPECT_EQ(loopOfOne, ends);
  }
}

}
