// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_XMLArrayHeader_h
#define freespace_XMLArrayHeader_h

#include <cstddef>
#include <string_view>

namespace freespace
{

/// The header before the values of an array in a file of VTK: the number of their bytes or, where they are
/// compressed, the number of blocks, the size of a block and of the last one, and the compressed sizes.
struct ArrayHeader
{
  static constexpr std::size_t mostText = 64;    ///< of base64 that is looked at
  static constexpr double mostCompressed = 1100; ///< zlib's and LZ4's limits are below

  std::string_view text; ///< from the header on
  bool isBase64 = false;
  bool isCompressed = false;
  bool isLong = false; ///< 8 bytes a number in place of 4

  /// Whether the described values fit into this number of bytes of text.
  bool Fits(std::size_t length) const;
};

}

#endif
