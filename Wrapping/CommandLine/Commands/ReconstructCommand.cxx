// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Data/SurfaceViewpoint.h"
#include "Output/Picture.h"
#include "Output/SurfaceFiles.h"
#include "Session/Session.h"
#include "Stages/ContourStage.h"
#include "Stages/FeatureStage.h"
#include "Stages/TriangulateStage.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <memory>

namespace freespace
{

namespace
{

struct ReconstructSettings
{
  std::string scene;
  std::string output;
  std::string picture;
  FeatureStage features;
  TriangulateStage triangulate;
  ContourStage contour;
};

void AddOptions(CLI::App& command, ReconstructSettings& settings)
{
  command
    .add_option("scene", settings.scene,
      "A scene.json, or a structure-from-motion model: a folder with COLMAP's files, or a file of "
      "another program")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command.add_option("-o,--output", settings.output, "The surface to write (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command
    .add_option("--picture", settings.picture,
      "Write a picture of the surface, too, from a viewpoint between the cameras")
    ->type_name("OUT.png");
  settings.features.AddOptions(command);
  settings.triangulate.AddOptions(command);
  settings.contour.AddOptions(command);
}

// That of the images, unless it is very large.
std::array<int, 2> SizeLike(const Camera& camera)
{
  constexpr double most = 2000;
  const double scale = std::min(1.0, most / std::max(camera.width, camera.height));
  return { std::max(1, static_cast<int>(scale * camera.width)),
    std::max(1, static_cast<int>(scale * camera.height)) };
}

void Write(Session& session, vtkPolyData* surface, const ReconstructSettings& settings)
{
  WriteSurface(session, surface, settings.output, settings.contour.GlobalShift());
  if (!settings.picture.empty())
  {
    PictureLook look;
    if (const auto viewpoint = ViewpointOf(surface))
    {
      look.size = SizeLike(*viewpoint);
    }
    WritePicture(session, surface, nullptr, look, settings.picture);
  }
}

void Reconstruct(Session& session, const ReconstructSettings& settings)
{
  if (session.IsWriter())
  {
    CheckSurfaceName(settings.output);
    if (!settings.picture.empty())
    {
      CheckPictureName(settings.picture);
    }
  }
  const auto features = settings.features.Run(session, settings.scene);
  const auto maps = settings.triangulate.Run(session, features);
  const auto surface = settings.contour.Run(session, maps);
  if (session.MayWrite())
  {
    Write(session, surface, settings);
  }
}

}

void AddReconstructCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ReconstructSettings>();
  CLI::App* command = program.add_subcommand("reconstruct",
    "Make a surface from images or a structure-from-motion model: all stages in one");
  AddOptions(*command, *settings);
  command->footer("Example:\n"
                  "  freespace reconstruct scene.json -o mesh.ply --picture mesh.png\n"
                  "  freespace reconstruct colmap/sparse/0 -o mesh.ply\n"
                  "  mpiexec -n 4 freespace reconstruct scene.json -o mesh.ply");
  command->callback(session.Defer(
    [settings, &session]() { Reconstruct(session, *settings); }, Session::Sharing::AllProcesses));
}

}
