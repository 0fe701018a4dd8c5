// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageSize_h
#define freespace_ImageSize_h

#include <array>
#include <optional>
#include <string>

namespace freespace
{

/// Width and height of an image as it is stored, pixels: of a JPEG or PNG from its header, of others by
/// decoding. Nothing if the file is missing or not an image.
std::optional<std::array<int, 2>> ReadImageSize(const std::string& path);

}

#endif
