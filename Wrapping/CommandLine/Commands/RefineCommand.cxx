// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Execution/SMPParallelFor.h"
#include "Refinement/CameraRefinement.h"
#include "Session/Session.h"
#include "SparseModel/ColmapModel.h"

#include <cstdio>
#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

struct RefineSettings
{
  std::string scene;
  std::string output;
  bool focalLengths = false;
  bool text = false;
};

void Refine(Session& session, const RefineSettings& settings)
{
  const Scene scene = ReadScene(settings.scene);
  const SparseModel model = ReadSceneModel(scene);
  CameraRefinementOptions options;
  options.adjustment.refineFocalLengths = settings.focalLengths;
  EdgeStore edges(scene, EdgeTokenOptions());
  const CameraRefinement refined =
    RefineCameras(scene, model, edges, MatcherOptions(), options, SMPParallelFor, Progress());
  WriteColmapModel(WithCameras(model, refined.images), settings.output,
    settings.text ? ColmapFormat::Text : ColmapFormat::Binary);
  session.Log("wrote the cameras in " + settings.output);
  char text[200];
  std::snprintf(text, sizeof(text),
    "%zu of %zu images matched, %zu tracks; median distance across the edges %.3f -> %.3f "
    "pixels%s\n",
    refined.clusters, model.images.size(), refined.tracks, refined.residuals.residualBefore,
    refined.residuals.residualAfter,
    refined.isRefined ? "" : ": the cameras fit as they are, and are written unchanged");
  std::cout << text;
}

}

void AddRefineCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<RefineSettings>();
  CLI::App* command =
    program.add_subcommand("refine", "Correct the cameras of a scene by the edges of its images");
  command->add_option("scene", settings->scene, "The scene.json")
    ->required()
    ->type_name("SCENE.json");
  command->add_option("-o,--output", settings->output, "The folder to write the cameras to")
    ->required()
    ->type_name("MODEL");
  command->add_flag("--focal-lengths", settings->focalLengths, "Correct the focal lengths, too");
  command->add_flag("--text", settings->text, "Write .txt rather than .bin files");
  command->footer("Writes a COLMAP model, in the frame and scale of the given one.\n"
                  "Example:\n  freespace refine scene.json -o refined");
  command->callback(session.Defer([settings, &session]() { Refine(session, *settings); }));
}

}
