// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Info/FileInfo.h"
#include "Session/Session.h"
#include "Tables/ResultFile.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace freespace
{

void AddInfoCommand(CLI::App& program, Session& session)
{
  struct InfoSettings
  {
    std::string file;
    std::string json;
  };
  auto settings = std::make_shared<InfoSettings>();
  CLI::App* command = program.add_subcommand(
    "info", "Print what a file holds: a surface, features, a scene, a model");
  command
    ->add_option("file", settings->file,
      "A surface, features or disparity maps, a scene.json, a camera model or an image")
    ->required()
    ->type_name("FILE");
  command->add_option("--json", settings->json, "Write it as JSON; -: to the standard output")
    ->type_name("FILE.json");
  command->footer(
    "Examples:\n  freespace info mesh.ply\n  freespace info colmap/sparse/0 --json -");
  command->callback(session.Defer(
    [settings, &session]()
    {
      CheckResultFile(settings->json);
      const nlohmann::ordered_json info = InfoOf(session, settings->file);
      if (!settings->json.empty())
      {
        WriteResult(settings->json, info);
      }
      if (settings->json != "-")
      {
        std::cout << InfoText(info);
      }
    }));
}

}
