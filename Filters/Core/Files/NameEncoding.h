// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NameEncoding_h
#define freespace_NameEncoding_h

#include <cstddef>
#include <string>

namespace freespace
{

/// The names of files are bytes, those in JSON and XML are UTF-8 without control characters. A byte that
/// cannot stand there becomes a character of the private use area, U+EF00 more than the byte (and so do the
/// bytes of these characters themselves), so that every name comes back from NameFromUtf8 as it was.
/// Names in UTF-8 stay as they are.
std::string Utf8FromName(const std::string& name);
std::string NameFromUtf8(const std::string& text);

/// How many bytes the character of UTF-8 at `at` has; 0 where there is none.
std::size_t Utf8CharacterLength(const std::string& text, std::size_t at);

/// A name for a message: control characters become escapes as in C.
std::string Printable(const std::string& text);

}

#endif
