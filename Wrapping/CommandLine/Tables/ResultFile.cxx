// SPDX-License-Identifier: BSD-3-Clause
#include "Tables/ResultFile.h"

#include "Files/AtomicOutput.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace freespace
{

void CheckResultFile(const std::string& fileName)
{
  if (!fileName.empty() && fileName != "-")
  {
    const AtomicOutput probe(fileName);
  }
}

void WriteResult(const std::string& fileName, const std::string& text)
{
  if (fileName == "-")
  {
    std::cout << text;
    return;
  }
  AtomicOutput target(fileName);
  target.Write(text.data(), text.size());
  target.Commit();
}

void WriteResult(const std::string& fileName, const nlohmann::ordered_json& results)
{
  // File names need not be valid UTF-8, but JSON must be.
  using Handler = nlohmann::ordered_json::error_handler_t;
  WriteResult(fileName, results.dump(2, ' ', false, Handler::replace) + "\n");
}

}
