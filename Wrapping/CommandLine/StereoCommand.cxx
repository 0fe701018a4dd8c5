// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "Session.h"
#include "Stages.h"

#include <vtkMultiBlockDataSet.h>

#include <memory>

namespace freespace
{

namespace
{

struct Settings
{
  std::string scene;
  std::string output;
  StereoStage stereo;
};

}

void AddStereoCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
    program.add_subcommand("stereo", "Find the features of each cluster of images");
  command->add_option("scene", settings->scene, "The scene.json")
    ->required()
    ->type_name("SCENE.json");
  command->add_option("-o,--output", settings->output, "The features to write")
    ->required()
    ->type_name("FEATURES.vtm");
  settings->stereo.AddOptions(*command);
  command->footer("Example:\n  freespace stereo scene.json -o features.vtm");
  command->callback([settings, &session]()
    { WriteViews(session, settings->stereo.Run(session, settings->scene), settings->output); });
}

}
