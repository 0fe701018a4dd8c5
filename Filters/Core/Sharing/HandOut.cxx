// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/HandOut.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace freespace
{

HandOut::HandOut(const SharedLoop& loop, int processes)
  : Loop(loop)
  , Order(loop.work.size())
  , First(processes, 0)
  , Passed(processes, 0)
  , Given(processes, 0)
  , States(loop.work.size(), State::Open)
  , Makers(loop.work.size(), 0)
  , Made(loop.work.size())
  , Open(loop.work.size())
  , FirstFailed(loop.work.size())
  , All(std::max(std::accumulate(loop.work.begin(), loop.work.end(), 0.0), 1e-300))
{
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  std::stable_sort(this->Order.begin(), this->Order.end(),
    [&](std::size_t a, std::size_t b) { return loop.work[a] > loop.work[b]; });
  for (int process = 0; process < processes && loop.areNeighborsAlike; ++process)
  {
    this->First[process] = process * loop.work.size() / processes;
  }
}

std::vector<std::size_t> HandOut::Give(int process, int most)
{
  std::vector<std::size_t> items;
  for (std::size_t& passed = this->Passed[process];
       passed < this->Order.size() && static_cast<int>(items.size()) < most; ++passed)
  {
    const std::size_t item = this->Order[(this->First[process] + passed) % this->Order.size()];
    if (this->States[item] == State::Open)
    {
      this->States[item] = State::Given;
      this->Makers[item] = process;
      ++this->Given[process];
      --this->Open;
      items.push_back(item);
    }
  }
  return items;
}

void HandOut::Accept(int process, std::vector<MadeItem> made)
{
  for (MadeItem& one : made)
  {
    const std::size_t item = one.item;
    --this->Given[process];
    this->Done += this->Loop.work[item];
    this->States[item] = State::Made;
    if (one.hasFailed && item < this->FirstFailed)
    {
      this->FirstFailed = item;
      for (std::size_t later = item + 1; later < this->States.size(); ++later)
      {
        if (this->States[later] == State::Open)
        {
          this->States[later] = State::Skipped;
          --this->Open;
        }
      }
    }
    this->Made[item] = std::move(one);
  }
}

const MadeItem* HandOut::Failed() const
{
  return this->FirstFailed < this->Made.size() ? &this->Made[this->FirstFailed] : nullptr;
}

std::vector<MadeItem> HandOut::MadeByOthers(int process) const
{
  std::vector<MadeItem> others;
  for (const MadeItem& made : this->Made)
  {
    if (this->Makers[made.item] != process)
    {
      others.push_back(made);
    }
  }
  return others;
}

}
