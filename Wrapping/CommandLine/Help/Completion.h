// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Completion_h
#define freespace_Completion_h

#include "Help/CommandText.h"

namespace freespace
{

/// The scripts that complete the program's commands, options and files in bash and zsh.
std::string BashCompletion(const std::vector<CommandText>& texts);
std::string ZshCompletion(const std::vector<CommandText>& texts);

}

#endif
