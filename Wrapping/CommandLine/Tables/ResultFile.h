// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ResultFile_h
#define freespace_ResultFile_h

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace freespace
{

/// Throws Error when a file for results cannot be written. "-" is the standard output, an empty name none.
void CheckResultFile(const std::string& fileName);

/// Writes results at once, or to the standard output for "-". Throws Error when that fails.
void WriteResult(const std::string& fileName, const std::string& text);
void WriteResult(const std::string& fileName, const nlohmann::ordered_json& results);

}

#endif
