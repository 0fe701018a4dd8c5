// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/LoopThreads.h"

#include <exception>
#include <string>
#include <utility>

namespace freespace
{

LoopThreads::LoopThreads(const SharedLoop& loop, const ParallelFor& parallelFor)
  : Loop(loop)
{
  // Each index of the parallel loop takes an item, whichever, or none when all are made.
  this->Threads = std::async(std::launch::async,
    [this, parallelFor]
    {
      parallelFor(this->Loop.work.size(),
        [this](std::size_t begin, std::size_t end)
        {
          for (; begin < end && !this->Stop; ++begin)
          {
            this->Work();
          }
        });
    });
}

LoopThreads::~LoopThreads()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Stop = true;
  }
  this->Arrived.notify_all();
  this->Threads.wait();
}

int LoopThreads::Waiting()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Idle - static_cast<int>(this->Items.size());
}

void LoopThreads::Give(const std::vector<std::size_t>& items)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Items.insert(this->Items.end(), items.begin(), items.end());
  }
  this->Arrived.notify_all();
}

std::vector<MadeItem> LoopThreads::TakeMade()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return std::exchange(this->Made, {});
}

std::optional<std::size_t> LoopThreads::Next()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  ++this->Idle;
  this->Arrived.wait(lock, [this] { return this->Stop || !this->Items.empty(); });
  --this->Idle;
  if (this->Stop)
  {
    return std::nullopt;
  }
  const std::size_t item = this->Items.front();
  this->Items.pop_front();
  return item;
}

void LoopThreads::Work()
{
  const std::optional<std::size_t> item = this->Next();
  if (!item)
  {
    return;
  }
  MadeItem made;
  made.item = *item;
  try
  {
    made.bytes = this->Loop.make(*item, this->Stop);
  }
  catch (const std::exception& error)
  {
    made.hasFailed = true;
    made.bytes = error.what();
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Made.push_back(std::move(made));
}

}
