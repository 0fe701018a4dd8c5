// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LowestBit_h
#define freespace_LowestBit_h

#include <cstdint>

namespace freespace
{

/// The number of trailing zero bits of a value other than zero.
inline int LowestBit(std::uint64_t bits)
{
#if defined(__GNUC__)
  return __builtin_ctzll(bits);
#else
  int bit = 0;
  for (; (bits & 1) == 0; bits >>= 1)
  {
    ++bit;
  }
  return bit;
#endif
}

}

#endif
