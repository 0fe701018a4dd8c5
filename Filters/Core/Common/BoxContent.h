// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoxContent_h
#define freespace_BoxContent_h

namespace freespace
{

/// What a closed box holds.
enum class BoxContent
{
  Free,
  Matter,
  Mixed ///< both, or not known
};

}

#endif
