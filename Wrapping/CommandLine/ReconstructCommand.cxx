// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "Picture.h"
#include "Session.h"
#include "Stages.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <memory>

namespace freespace
{

namespace
{

struct Settings
{
  std::string scene;
  std::string output;
  std::string picture;
  StereoStage stereo;
  TriangulateStage triangulate;
  ContourStage contour;
};

void AddOptions(CLI::App& command, Settings& settings)
{
  command.add_option("scene", settings.scene, "The scene.json")
    ->required()
    ->type_name("SCENE.json");
  command.add_option("-o,--output", settings.output, "The surface to write (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command.add_option("--picture", settings.picture, "Write a picture of the surface, too")
    ->type_name("OUT.png");
  settings.stereo.AddOptions(command);
  settings.triangulate.AddOptions(command);
  settings.contour.AddOptions(command);
}

void Reconstruct(Session& session, const Settings& settings)
{
  CheckSurfaceName(settings.output);
  const auto features = settings.stereo.Run(session, settings.scene);
  const auto maps = settings.triangulate.Run(session, features);
  const auto surface = settings.contour.Run(session, maps);
  WriteSurface(session, surface, settings.output);
  if (!settings.picture.empty())
  {
    WritePicture(session, surface, nullptr, settings.picture);
  }
}

}

void AddReconstructCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
    program.add_subcommand("reconstruct", "Make a surface from photographs: all stages in one");
  AddOptions(*command, *settings);
  command->footer("Example:\n"
                  "  freespace reconstruct scene.json -o mesh.ply --cells 256 --picture mesh.png");
  command->callback([settings, &session]() { Reconstruct(session, *settings); });
}

}
