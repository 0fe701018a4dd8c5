// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_HandOut_h
#define freespace_HandOut_h

#include "Sharing/SharedLoop.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// Which process makes which item of a loop: each is given the next one when it has made one.
class HandOut
{
public:
  HandOut(const SharedLoop& loop, int processes);

  /// Up to `most` items for a process.
  std::vector<std::size_t> Give(int process, int most);
  void Accept(int process, std::vector<MadeItem> made);

  /// Whether there is an item to give; after a failure, only those before it count, so that the first one is
  /// told as by a single process.
  bool HasItems() const { return this->Open > 0; }

  /// Whether a process has made all that it was given.
  bool IsIdle(int process) const { return this->Given[process] == 0; }

  double Fraction() const { return this->Done / this->All; }

  /// Null where none has failed.
  const MadeItem* Failed() const;

  /// What a process has not made itself.
  std::vector<MadeItem> MadeByOthers(int process) const;

private:
  enum class State : char
  {
    Open,
    Given,
    Made,
    Skipped
  };

  const SharedLoop& Loop;
  std::vector<std::size_t> Order;  // of the items, the most expensive first
  std::vector<std::size_t> First;  // where in this order a process begins
  std::vector<std::size_t> Passed; // places from there on where nothing is left
  std::vector<int> Given;          // items that a process has not made yet
  std::vector<State> States;       // per item, as what follows
  std::vector<int> Makers;
  std::vector<MadeItem> Made;
  std::size_t Open;
  std::size_t FirstFailed;
  double Done = 0;
  double All;
};

}

#endif
