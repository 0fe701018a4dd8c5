// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Mesh/MeshOperations.h"
#include "Output/SurfaceFiles.h"
#include "Session/Session.h"

#include <vtkPolyData.h>

#include <memory>

namespace freespace
{

namespace
{

struct MeshSettings
{
  std::string input;
  std::string output;
  GlobalShiftOption globalShift;
};

std::string Counts(vtkPolyData* surface)
{
  return std::to_string(surface->GetNumberOfPoints()) + " points, " +
    std::to_string(surface->GetNumberOfPolys()) + " triangles";
}

void Edit(
  Session& session, const MeshSettings& settings, const std::vector<MeshOperation>& operations)
{
  CheckSurfaceName(settings.output);
  for (const MeshOperation& operation : operations)
  {
    CheckOperation(operation);
  }
  vtkSmartPointer<vtkPolyData> surface = ReadSurface(session, settings.input);
  session.Log(settings.input + ": " + Counts(surface));
  for (const MeshOperation& operation : operations)
  {
    surface = Operate(session, operation, surface);
    if (surface->GetNumberOfPolys() == 0)
    {
      throw Error("Nothing is left of the surface after " + operation.Text() + ".");
    }
    session.Log(operation.Text() + ": " + Counts(surface));
  }
  WriteSurface(session, surface, settings.output, settings.globalShift);
}

}

void AddMeshCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<MeshSettings>();
  CLI::App* command = program.add_subcommand(
    "mesh", "Edit a surface: crop, clean, smooth, decimate, fill, transform, colour");
  command->add_option("mesh", settings->input, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command->add_option("-o,--output", settings->output, "The surface to write (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("OUT.ply");
  settings->globalShift.AddTo(*command);
  AddMeshOperations(*command);
  command->footer(
    "Examples:\n"
    "  freespace mesh mesh.ply --largest 1 --smooth 0.01 --triangles 50000 -o small.ply\n"
    "  freespace mesh mesh.ply --normals --colour-from scene.json -o coloured.ply");
  command->callback(session.Defer(
    [settings, command, &session]() { Edit(session, *settings, OperationsInOrder(*command)); }));
}

}
