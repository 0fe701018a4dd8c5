// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DataUri_h
#define freespace_DataUri_h

#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// Bytes as text (RFC 4648, padded).
std::string Base64(const void* bytes, std::size_t count);

/// The same for the numbers of a vector, as they lie in memory.
template <typename T>
std::string Base64(const std::vector<T>& values)
{
  return Base64(values.data(), values.size() * sizeof(T));
}

/// A picture within a page: its data and its size in pixels.
struct InlinePicture
{
  std::string uri; ///< "data:image/jpeg;base64,..."
  int width = 0;
  int height = 0;
};

/// A picture of a file as a JPEG, no wider than `widest` pixels. `quality` is JPEG's, 1 to 100. Throws Error
/// naming the file when it is no picture.
InlinePicture InlinePictureFromFile(const std::string& file, int widest, int quality = 86);

}

#endif
