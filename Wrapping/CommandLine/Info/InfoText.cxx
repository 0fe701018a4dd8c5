// SPDX-License-Identifier: BSD-3-Clause
#include "Files/NameEncoding.h"
#include "Info/FileInfo.h"
#include "Tables/TextTable.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::size_t MostWords = 6;
constexpr std::size_t MostRows = 60;

// mean_angle -> mean angle
std::string Words(std::string key)
{
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

std::string ValueText(const Json& value)
{
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_boolean())
  {
    return value.get<bool>() ? "yes" : "no";
  }
  if (value.is_number_float())
  {
    return NumberText(value.get<double>(), 6);
  }
  if (value.is_array() || value.is_object())
  {
    std::string text;
    std::size_t count = 0;
    for (const auto& [key, item] : value.items())
    {
      if (++count > MostWords)
      {
        return text + ", ... (" + std::to_string(value.size()) + ")";
      }
      text +=
        (text.empty() ? "" : ", ") + (value.is_object() ? Words(key) + " " : "") + ValueText(item);
    }
    return text.empty() ? "none" : text;
  }
  return value.dump();
}

bool IsTable(const Json& value)
{
  return value.is_array() && !value.empty() && value.front().is_object();
}

std::string TableText(const std::string& title, const Json& rows)
{
  TextTable table;
  std::vector<std::string> head;
  for (const auto& [key, value] : rows.front().items())
  {
    head.push_back(Words(key));
  }
  table.Add(head);
  for (std::size_t i = 0; i < std::min(rows.size(), MostRows); ++i)
  {
    std::vector<std::string> row;
    for (const auto& [key, value] : rows[i].items())
    {
      row.push_back(ValueText(value));
    }
    table.Add(row);
  }
  const std::string more = rows.size() > MostRows
    ? "... and " + std::to_string(rows.size() - MostRows) + " more (--json has all)\n"
    : "";
  return "\n" + Words(title) + ":\n" + table.Text() + more;
}

}

std::string InfoText(const Json& info)
{
  std::string tables, text;
  for (const auto& [key, value] : info.items())
  {
    if (IsTable(value))
    {
      tables += TableText(key, value);
    }
    else
    {
      text += Words(key) + ": " + Printable(ValueText(value)) + "\n";
    }
  }
  return text + tables;
}

}
