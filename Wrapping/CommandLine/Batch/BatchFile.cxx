// SPDX-License-Identifier: BSD-3-Clause
#include "Batch/BatchFile.h"

#include "Common/Error.h"
#include "Files/PathChecks.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

[[noreturn]] void Fail(const std::string& file, const std::string& fault)
{
  throw Error("Cannot read '" + file + "': " + fault + ".");
}

Json Parse(const std::string& file)
{
  std::ifstream stream(file);
  Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object())
  {
    Fail(file, "it is no JSON object with the key steps");
  }
  for (const auto& [key, value] : json.items())
  {
    if (key != "steps" && key != "table")
    {
      Fail(file, "it has an unknown key '" + key + "'");
    }
  }
  return json;
}

std::vector<std::string> StepFrom(const Json& json, const std::string& file)
{
  std::vector<std::string> words;
  if (json.is_string())
  {
    std::istringstream text(json.get<std::string>());
    for (std::string word; text >> word;)
    {
      words.push_back(word);
    }
  }
  for (const Json& word : json.is_array() ? json : Json::array())
  {
    if (!word.is_string())
    {
      Fail(file, "a word of a step is no text");
    }
    words.push_back(word.get<std::string>());
  }
  if (words.empty())
  {
    Fail(file, "a step is neither a text nor a list of words");
  }
  return words;
}

BatchFile::Column ColumnFrom(const std::string& name, const Json& json, const std::string& file)
{
  const std::string text = json.is_string() ? json.get<std::string>() : "";
  const std::size_t colon = text.rfind(":/");
  if (colon == std::string::npos || colon == 0)
  {
    Fail(file, "the column '" + name + "' of its table is not FILE.json:/pointer");
  }
  return { name, text.substr(0, colon), text.substr(colon + 1) };
}

void Replace(std::string& text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
  }
}

}

BatchFile ReadBatch(const std::string& file, const std::vector<std::string>& commands)
{
  const Json json = Parse(file);
  BatchFile batch;
  if (!json.contains("steps") || !json["steps"].is_array() || json["steps"].empty())
  {
    Fail(file, "its key steps is no list of steps");
  }
  for (const Json& step : json["steps"])
  {
    batch.steps.push_back(StepFrom(step, file));
    const std::string& command = batch.steps.back().front();
    if (std::find(commands.begin(), commands.end(), command) == commands.end())
    {
      Fail(file, "there is no command '" + command + "' that a step can be");
    }
  }
  const Json table = json.value("table", Json::object());
  if (!table.is_object())
  {
    Fail(file, "its key table is no object");
  }
  for (const auto& [name, column] : table.items())
  {
    batch.table.push_back(ColumnFrom(name, column, file));
  }
  return batch;
}

std::vector<BatchScene> FindScenes(const std::vector<std::string>& paths)
{
  std::vector<BatchScene> scenes;
  std::set<std::string> names;
  for (const std::string& given : paths)
  {
    if (!IsThere(given))
    {
      throw Error("The scene '" + given + "' does not exist.");
    }
    const fs::path path = fs::canonical(given);
    const fs::path named = path.filename() == "scene.json" ? path.parent_path() : path;
    const bool isFolder = IsFolder(named);
    scenes.push_back({ path.string(), (isFolder ? named.filename() : named.stem()).string() });
    if (!names.insert(scenes.back().name).second)
    {
      throw Error("Two scenes have the name '" + scenes.back().name +
        "', which is that of the folder of their results.");
    }
  }
  return scenes;
}

std::vector<std::string> WordsFor(const std::vector<std::string>& step, const BatchScene& scene)
{
  std::vector<std::string> words = step;
  const fs::path path = scene.path;
  const std::string folder = IsFolder(path) ? scene.path : path.parent_path().string();
  for (std::string& word : words)
  {
    Replace(word, "{scene}", scene.path);
    Replace(word, "{folder}", folder);
    Replace(word, "{name}", scene.name);
  }
  return words;
}

}
