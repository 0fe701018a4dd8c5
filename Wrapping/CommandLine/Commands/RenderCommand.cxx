// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Session/NumberValidators.h"

#include "Common/Error.h"
#include "Data/ObservedTriangles.h"
#include "Data/ViewBlocks.h"
#include "Output/PictureOptions.h"
#include "Output/SurfaceFiles.h"
#include "Output/Viewpoint.h"
#include "Session/Session.h"

#include <vtkCameraReader.h>
#include <vtkCellData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

namespace freespace
{

namespace
{

struct RenderSettings
{
  std::string mesh;
  std::string output;
  std::string scene;
  std::string model;
  std::string view;
  PictureOptions picture;
  PictureLook look;
  CLI::Option* azimuth = nullptr;
  CLI::Option* elevation = nullptr;
  bool observed = false;
};

void AddOptions(CLI::App& command, RenderSettings& settings)
{
  command.add_option("mesh", settings.mesh, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command.add_option("-o,--output", settings.output, "The picture to write")
    ->required()
    ->type_name("OUT.png");
  auto* scene = command
                  .add_option("--scene", settings.scene,
                    "The scene whose camera to look from; without --view from between its cameras")
                  ->type_name("SCENE.json|MODEL");
  auto* model =
    command.add_option("--model", settings.model, "The same for the cameras of a model")
      ->type_name("MODEL")
      ->excludes(scene);
  auto* view =
    command.add_option("--view", settings.view, "The image whose camera it is")->type_name("NAME");
  const auto addWithoutCamera = [&](CLI::Option* option)
  { option->excludes(scene)->excludes(model)->excludes(view)->group("Without a camera"); };
  settings.picture.AddSize(command);
  settings.azimuth =
    command
      .add_option("--azimuth", settings.look.azimuth,
        "Azimuth of the viewpoint, degrees around z, from x towards y; default if the "
        "surface has no stored viewpoint, which .ply and .vtp of this program "
        "have")
      ->check(Between(-360.0, 360.0))
      ->capture_default_str();
  settings.elevation = command
                         .add_option("--elevation", settings.look.elevation,
                           "Elevation of the viewpoint, degrees above the xy plane")
                         ->check(Between(-90.0, 90.0))
                         ->capture_default_str();
  addWithoutCamera(settings.azimuth);
  addWithoutCamera(settings.elevation);
  command.add_flag("--observed", settings.observed,
    "Omit what no view observed, the hull and silhouette walls; the surface must be a .vtp, "
    "which has the required arrays");
  settings.picture.AddLook(command);
  settings.picture.AddComparison(command);
}

vtkSmartPointer<vtkPolyData> FindView(
  Session& session, const RenderSettings& settings, vtkPolyData* surface)
{
  const std::string& source = settings.scene.empty() ? settings.model : settings.scene;
  if (source.empty())
  {
    if (!settings.view.empty())
    {
      throw Error("--view names a camera of --scene or --model: give one of them.");
    }
    return nullptr;
  }
  vtkNew<vtkCameraReader> cameras;
  cameras->SetFileName(source);
  session.Run(cameras, "cameras");
  if (settings.view.empty())
  {
    View between;
    between.camera = ViewpointOfCameras(cameras->GetOutput(), surface, source);
    return BlockFromView(between);
  }
  vtkSmartPointer<vtkPolyData> view = cameras->GetView(settings.view);
  if (!view)
  {
    throw Error(source + " has no image '" + settings.view + "'.");
  }
  return view;
}

void LeaveOutUnseen(vtkPolyData* surface, const std::string& fileName)
{
  if (!surface->GetCellData()->HasArray("Kind"))
  {
    throw Error(fileName +
      " does not tell which triangles were seen, as a .vtp that 'freespace contour' "
      "wrote does: --observed cannot be.");
  }
  KeepObserved(surface);
}

void Render(Session& session, const RenderSettings& settings)
{
  const auto surface = ReadSurface(session, settings.mesh);
  if (settings.observed)
  {
    LeaveOutUnseen(surface, settings.mesh);
  }
  PictureLook look = settings.look;
  look.useViewpoint = settings.azimuth->count() == 0 && settings.elevation->count() == 0;
  settings.picture.Apply(look);
  const auto view = Resized(FindView(session, settings, surface), settings.picture.Size());
  WritePicture(session, surface, view, look, settings.output);
  settings.picture.Compare(session, settings.output);
}

}

void AddRenderCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<RenderSettings>();
  CLI::App* command = program.add_subcommand("render", "Make a picture of a surface");
  AddOptions(*command, *settings);
  command->footer(
    "Examples:\n"
    "  freespace render mesh.ply -o mesh.png --azimuth 30 --elevation 60\n"
    "  freespace render mesh.ply -o mesh.png --scene scene.json\n"
    "  freespace render mesh.ply -o mesh.png --scene scene.json --view c.jpg\n"
    "  freespace render mesh.vtp -o mesh.png --color-by Kind --edges --zoom 2\n"
    "  freespace render mesh.ply -o mesh.png --ref baseline.png --diff difference.png");
  command->callback(session.Defer([settings, &session]() { Render(session, *settings); }));
}

}
