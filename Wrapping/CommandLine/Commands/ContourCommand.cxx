// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/SurfaceFiles.h"
#include "Output/ViewFiles.h"
#include "Session/Session.h"
#include "Stages/ContourStage.h"

#include <vtkBisectionContourFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <memory>

namespace freespace
{

namespace
{

struct ContourSettings
{
  std::string maps;
  std::string output;
  ContourStage contour;
};

// All processes read the maps for themselves.
void Contour(Session& session, const ContourSettings& settings)
{
  if (session.IsWriter())
  {
    CheckSurfaceName(settings.output);
  }
  const auto maps = ReadMaps(session, settings.maps);
  const auto filter = settings.contour.MakeFilter(maps);
  settings.contour.Choose(session, filter);
  if (!session.Shared() && settings.contour.Stream(session, filter, maps, settings.output))
  {
    return;
  }
  const auto surface = settings.contour.Make(session, filter, maps);
  if (session.MayWrite())
  {
    WriteSurface(session, surface, settings.output, settings.contour.GlobalShift());
  }
}

}

void AddContourCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ContourSettings>();
  CLI::App* command =
    program.add_subcommand("contour", "Make the surface: the boundary of the free space");
  command->add_option("maps", settings->maps, "What 'triangulate' wrote")
    ->required()
    ->type_name("MAPS.vtm");
  command->add_option("-o,--output", settings->output, "The surface to write (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  settings->contour.AddOptions(*command);
  command->footer("Example:\n  freespace contour maps.vtm -o mesh.ply --cells 512\n"
                  "  mpiexec -n 4 freespace contour maps.vtm -o mesh.ply --cells 2048");
  command->callback(session.Defer(
    [settings, &session]() { Contour(session, *settings); }, Session::Sharing::AllProcesses));
}

}
