// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TextSource_h
#define freespace_TextSource_h

#include "Common/ParseNumber.h"

#include <optional>
#include <string>
#include <string_view>

namespace freespace
{

/// The content of a file. Throws Error naming it when it cannot be read.
std::string ReadWholeFile(const std::string& file);

/// The first bytes of a file, at most this many, which determine its format; empty if it cannot be read.
std::string BeginOfFile(const std::string& file, std::size_t most);

/// Reads a text file by lines and the fields of a line, which are separated by blanks. A byte order mark of
/// UTF-8 at its beginning is skipped. Throws Error naming the file, the line and the fault if the text is
/// not as requested.
class TextSource
{
public:
  enum class Lines
  {
    Separate, ///< a field is sought in the current line only
    Blank     ///< the end of a line, an empty line and a comment are blanks like others
  };

  explicit TextSource(const std::string& file, Lines lines = Lines::Separate);

  [[noreturn]] void Fail(const std::string& fault) const;

  /// Goes to the next line; false at the end of the file.
  bool NextLine();

  /// Goes to the next line that is neither empty nor a comment, which begins with #.
  bool NextEntry();

  bool AtLineEnd() const { return this->Rest.empty(); }

  /// The next field; `what` describes it in error messages.
  std::string_view Field(const char* what);

  /// The rest of the line.
  std::string_view Remainder(const char* what);

  /// The rest of the line, without reading it.
  std::string_view Ahead() const { return this->Rest; }

  /// The next field as a number.
  template <typename Value>
  Value Number(const char* what)
  {
    const std::string_view field = this->Field(what);
    const std::optional<Value> value = ParseNumber<Value>(field);
    if (!value)
    {
      this->Fail("'" + std::string(field.substr(0, 40)) + "' is not " + what);
    }
    return *value;
  }

private:
  void NeedField(const char* what);

  std::string File;
  std::string Content;
  Lines EndsOfLines;
  std::size_t Position = 0;
  std::size_t Line = 0;
  std::string_view Rest;
};

}

#endif
