// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceWords_h
#define freespace_SurfaceWords_h

#include "Common/Error.h"
#include "Common/ParseNumber.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace freespace
{

/// The words of a surface file in text form, separated by blanks and line ends.
class SurfaceWords
{
public:
  SurfaceWords(std::string_view text, std::string_view file)
    : Text(text)
    , File(file)
  {
  }

  /// The next word; empty at the end.
  std::string_view Next()
  {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::size_t begin = std::min(this->Text.find_first_not_of(blanks), this->Text.size());
    this->Text.remove_prefix(begin);
    const std::string_view word =
      this->Text.substr(0, std::min(this->Text.find_first_of(blanks), this->Text.size()));
    this->Text.remove_prefix(word.size());
    return word;
  }

  /// The next word as a number. Throws Error naming the file.
  template <typename Value>
  Value Number()
  {
    const std::string_view word = this->Next();
    const auto value = ParseNumber<Value>(word);
    if (!value)
    {
      throw Error("Cannot read " + std::string(this->File) + ": " +
        (word.empty() ? "it is truncated."
                      : "'" + std::string(word.substr(0, 40)) + "' is not a number of its kind."));
    }
    return *value;
  }

private:
  std::string_view Text;
  std::string_view File;
};

}

#endif
