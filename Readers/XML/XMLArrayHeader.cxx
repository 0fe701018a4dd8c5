// SPDX-License-Identifier: BSD-3-Clause
#include "XML/XMLArrayHeader.h"

#include <vtkBase64Utilities.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace freespace
{

namespace
{

std::uint64_t WordAt(const unsigned char* bytes, std::size_t index, bool isLong)
{
  if (isLong)
  {
    std::uint64_t word;
    std::memcpy(&word, bytes + 8 * index, sizeof word);
    return word;
  }
  std::uint32_t word;
  std::memcpy(&word, bytes + 4 * index, sizeof word);
  return word;
}

}

bool ArrayHeader::Fits(std::size_t length) const
{
  std::array<unsigned char, 48> bytes = {};
  const std::string_view begin = this->text.substr(0, mostText);
  std::size_t decoded = 0;
  if (this->isBase64)
  {
    decoded = vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(begin.data()),
      begin.size() / 4 * 4, bytes.data(), bytes.size());
  }
  else
  {
    decoded = std::min(begin.size(), bytes.size());
    std::memcpy(bytes.data(), begin.data(), decoded);
  }
  const std::size_t word = this->isLong ? 8 : 4;
  const double size = static_cast<double>(length) * (this->isBase64 ? 0.75 : 1.0);
  const auto at = [&](std::size_t index)
  { return static_cast<double>(WordAt(bytes.data(), index, this->isLong)); };
  if (!this->isCompressed)
  {
    return decoded >= word && at(0) <= size - static_cast<double>(word);
  }
  if (decoded < word || at(0) == 0) // an empty array has no blocks and no more of a header
  {
    return decoded >= word;
  }
  return decoded >= 3 * word && (3 + at(0)) * static_cast<double>(word) <= size &&
    at(0) * at(1) <= mostCompressed * size + 65536 && at(2) <= mostCompressed * size + 65536;
}

}
