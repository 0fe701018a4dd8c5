// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LargeVector_h
#define freespace_LargeVector_h

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace freespace
{

/// Allocates large pages for large arrays: the page faults of a megabyte of small pages take longer than
/// filling it. New elements of a vector are not initialized.
template <typename T>
struct LargePages
{
  using value_type = T;

  LargePages() = default;
  template <typename U>
  LargePages(const LargePages<U>&)
  {
  }

  T* allocate(std::size_t count)
  {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    const std::size_t bytes = (count * sizeof(T) + Page - 1) / Page * Page;
    if (count * sizeof(T) >= Page / 2)
    {
      void* memory = std::aligned_alloc(Page, bytes);
      if (!memory)
      {
        throw std::bad_alloc();
      }
      madvise(memory, bytes, MADV_HUGEPAGE); // refused, all goes on as without
      return static_cast<T*>(memory);
    }
#endif
    void* memory = std::malloc(count * sizeof(T));
    if (!memory)
    {
      throw std::bad_alloc();
    }
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t)
  {
    std::free(memory);
  }

  template <typename U>
  void construct(U* place)
  {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }

  template <typename U>
  bool operator==(const LargePages<U>&) const
  {
    return true;
  }
  template <typename U>
  bool operator!=(const LargePages<U>&) const
  {
    return false;
  }

private:
  static constexpr std::size_t Page = std::size_t(2) << 20;
};

template <typename T>
using LargeVector = std::vector<T, LargePages<T>>;

}

#endif
