// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoxContent_h
#define freespace_BoxContent_h

namespace freespace
{

/// The content of a closed box.
enum class BoxContent
{
  Free,
  Matter,
  Mixed ///< both, or not known
};

}

#endif
