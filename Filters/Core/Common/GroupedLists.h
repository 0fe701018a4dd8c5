// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GroupedLists_h
#define freespace_GroupedLists_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace freespace
{

/// Where the list of each key 0, 1, ... begins in an array of the values of all keys, sorted by key, and the array's
/// size. visitKeys(add) has to call add(key) once for each value, with keys below `keys`. O(n).
template <typename Index, typename VisitKeys>
std::vector<Index> BeginOfLists(std::size_t keys, const VisitKeys& visitKeys)
{
  std::vector<Index> begin(keys + 1, 0);
  visitKeys([&begin](std::size_t key) { ++begin[key + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

/// A list of values for each key 0, 1, ..., all in one array (compressed sparse rows). Index is an integer that holds
/// the number of values.
template <typename Value = int, typename Index = int>
class GroupedLists
{
public:
  /// One list.
  struct Range
  {
    const Value* first;
    const Value* last;
    const Value* begin() const { return this->first; }
    const Value* end() const { return this->last; }
    std::size_t size() const { return static_cast<std::size_t>(this->last - this->first); }
    const Value& operator[](std::size_t i) const { return this->first[i]; }
  };

  GroupedLists() = default;

  /// Calls visitPairs(add) twice, to count and to store the values. Both times it has to call
  /// add(key, value) for the same pairs, with keys below `keys`. Each list keeps their order. O(n).
  template <typename VisitPairs>
  GroupedLists(std::size_t keys, const VisitPairs& visitPairs)
    : Begin(BeginOfLists<Index>(keys + 1, // the last list is empty: each begin is one place late
        [&visitPairs](const auto& add)
        { visitPairs([&add](std::size_t key, const Value&) { add(key + 1); }); }))
  {
    this->Values.resize(this->Begin.back());
    visitPairs([this](std::size_t key, const Value& value)
      { this->Values[this->Begin[key + 1]++] = value; });
    this->Begin.pop_back();
  }

  std::size_t NumberOfKeys() const { return this->Begin.size() - 1; }

  Range operator[](std::size_t key) const { return this->Between(key, key + 1); }

  /// The lists of the keys [first, last) as one.
  Range Between(std::size_t first, std::size_t last) const
  {
    return { this->Values.data() + this->Begin[first], this->Values.data() + this->Begin[last] };
  }

  /// The values of all lists, sorted by key, equal keys in the given order.
  const std::vector<Value>& AllValues() const { return this->Values; }

  /// Sorts each list by isBefore(value, value).
  template <typename IsBefore>
  void SortLists(const IsBefore& isBefore)
  {
    for (std::size_t key = 0; key < this->NumberOfKeys(); ++key)
    {
      std::sort(this->Values.data() + this->Begin[key], this->Values.data() + this->Begin[key + 1],
        isBefore);
    }
  }

  /// Removes the values for which keep(key, value) is false. Called in the order of the lists.
  template <typename Keep>
  void Filter(const Keep& keep)
  {
    Index kept = 0;
    for (std::size_t key = 0; key < this->NumberOfKeys(); ++key)
    {
      const Index begin = kept;
      for (Index i = this->Begin[key]; i < this->Begin[key + 1]; ++i)
      {
        if (keep(key, this->Values[i]))
        {
          this->Values[kept++] = this->Values[i];
        }
      }
      this->Begin[key] = begin;
    }
    this->Begin.back() = kept;
    this->Values.resize(kept);
  }

private:
  std::vector<Index> Begin = { 0 };
  std::vector<Value> Values;
};

}

#endif
