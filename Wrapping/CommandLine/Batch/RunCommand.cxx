// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Batch/BatchFile.h"
#include "Batch/BatchRun.h"
#include "Common/Error.h"
#include "Session/MachineMemory.h"
#include "Session/NumberValidators.h"
#include "Session/Ranks.h"
#include "Session/Session.h"
#include "Tables/ResultFile.h"
#include "Tables/TextTable.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

struct RunSettings
{
  std::string batch;
  std::vector<std::string> scenes;
  std::string output;
  std::string table;
  BatchOptions options;
};

void AddOptions(CLI::App& command, RunSettings& settings)
{
  command.add_option("batch", settings.batch, "The steps, as JSON")
    ->required()
    ->type_name("BATCH.json");
  command
    .add_option("scenes", settings.scenes,
      "What each step gets as {scene}: a scene.json, a camera model, or another file")
    ->required()
    ->expected(-1)
    ->type_name("SCENE");
  command
    .add_option("-o,--output", settings.output,
      "Folder of the results, one folder for each scene; a batch that was stopped goes on there")
    ->required()
    ->type_name("FOLDER");
  command
    .add_option("--jobs", settings.options.jobs, "Scenes at a time; 0: as many as there are cores")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
  settings.options.memoryLimit = ShareOfMemory();
  command
    .add_option("--memory-limit", settings.options.memoryLimit,
      "Limit of the memory of all scenes at a time, MiB, by what their steps have had in other "
      "scenes; 0: no limit; default: three quarters of the memory of the machine")
    ->check(NonNegative())
    ->type_name("MIB");
  command.add_option("--table", settings.table, "Write the table at the end")
    ->type_name("FILE.csv");
  command.add_flag("--fresh", settings.options.fresh, "Run all steps, also those already done");
}

// A value in a file of the results; empty if it is missing.
std::string ValueIn(const std::filesystem::path& folder, const BatchFile::Column& column)
{
  try
  {
    std::ifstream file(folder / column.file);
    const Json json = Json::parse(file);
    const Json& value = json.at(Json::json_pointer(column.pointer));
    return value.is_string()    ? value.get<std::string>()
      : value.is_number_float() ? NumberText(value.get<double>(), 6)
                                : value.dump();
  }
  catch (const std::exception&)
  {
    return "";
  }
}

std::vector<std::vector<std::string>> RowsOf(
  const RunSettings& settings, const BatchFile& batch, const std::vector<SceneResult>& results)
{
  std::vector<std::vector<std::string>> rows = { { "scene", "steps", "seconds", "MiB" } };
  for (const BatchFile::Column& column : batch.table)
  {
    rows.front().push_back(column.name);
  }
  rows.front().emplace_back("fault");
  for (const SceneResult& result : results)
  {
    rows.push_back(
      { result.name, std::to_string(result.stepsDone) + " of " + std::to_string(batch.steps.size()),
        NumberText(result.seconds, 3), NumberText(result.mebibytes, 3) });
    for (const BatchFile::Column& column : batch.table)
    {
      rows.back().push_back(ValueIn(std::filesystem::path(settings.output) / result.name, column));
    }
    rows.back().push_back(result.fault);
  }
  return rows;
}

std::string CsvOf(const std::vector<std::vector<std::string>>& rows)
{
  std::string text;
  for (const auto& row : rows)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      text += (i > 0 ? "," : "") + CsvCell(row[i]);
    }
    text += "\n";
  }
  return text;
}

void RunBatch(
  Session& session, const RunSettings& settings, const std::vector<std::string>& commands)
{
  ForgetLaunch(); // the steps are processes of their own
  const BatchFile batch = ReadBatch(settings.batch, commands);
  const std::vector<BatchScene> scenes = FindScenes(settings.scenes);
  CheckResultFile(settings.table);
  const std::vector<SceneResult> results =
    BatchRun(batch, scenes, settings.output, settings.options).Run(session);
  const auto rows = RowsOf(settings, batch, results);
  TextTable table;
  for (const auto& row : rows)
  {
    table.Add(row);
  }
  std::cout << table.Text();
  if (!settings.table.empty())
  {
    WriteResult(settings.table, CsvOf(rows));
  }
  const auto failed = std::count_if(results.begin(), results.end(),
    [](const SceneResult& result) { return !result.fault.empty(); });
  if (failed > 0)
  {
    throw Error(std::to_string(failed) + " of " + std::to_string(results.size()) +
      " scenes failed; '" + settings.output + "' has the logs of their steps.");
  }
}

// All but this one.
std::vector<std::string> CommandsOf(const CLI::App& program)
{
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({}))
  {
    if (command->get_name() != "run")
    {
      names.push_back(command->get_name());
    }
  }
  return names;
}

}

void AddRunCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<RunSettings>();
  CLI::App* command = program.add_subcommand(
    "run", "Run the steps of a batch over many scenes, resuming where it was stopped");
  AddOptions(*command, *settings);
  command->footer(
    "BATCH.json holds commands of this program: { \"steps\": [ \"reconstruct {scene} -o "
    "mesh.ply\", "
    "\"info mesh.ply --json info.json\" ], \"table\": { \"triangles\": \"info.json:/triangles\" } "
    "}. "
    "Paths are relative to the folder of the scene's results; {scene}, {folder} and {name} stand "
    "for the scene's path, its folder and its name.\n"
    "Example:\n  freespace run batch.json scenes/*/scene.json -o results --jobs 4");
  command->callback(session.Defer(
    [settings, &program, &session]() { RunBatch(session, *settings, CommandsOf(program)); }));
}

}
