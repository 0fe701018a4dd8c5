// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ManPage_h
#define freespace_ManPage_h

#include "Help/CommandText.h"

namespace freespace
{

/// A page of section 1 about the program or a command, in the language of man(7).
std::string ManPage(const CommandText& text, const std::string& version);

}

#endif
