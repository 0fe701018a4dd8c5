// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

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
  std::string maps;
  std::string output;
  ContourStage contour;
};

}

void AddContourCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
    program.add_subcommand("contour", "Make the surface: the boundary of the free space");
  command->add_option("maps", settings->maps, "What 'triangulate' wrote")
    ->required()
    ->type_name("MAPS.vtm");
  command->add_option("-o,--output", settings->output, "The surface to write (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  settings->contour.AddOptions(*command);
  command->footer("Example:\n  freespace contour maps.vtm -o mesh.ply --cells 512");
  command->callback(session.Later(
    [settings, &session]()
    {
      CheckSurfaceName(settings->output);
      const auto maps = ReadMaps(session, settings->maps);
      WriteSurface(session, settings->contour.Run(session, maps), settings->output);
    }));
}

}
