// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_HelpFormatter_h
#define freespace_HelpFormatter_h

#include "Help/CommandText.h"

namespace freespace
{

/// The text of --help, in lines of 80 columns.
std::string HelpText(const CommandText& text);

class HelpFormatter : public CLI::FormatterBase
{
public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override
  {
    return HelpText(TextOf(*app));
  }
};

}

#endif
