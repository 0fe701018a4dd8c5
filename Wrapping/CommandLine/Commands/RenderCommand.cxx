// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Session/NumberValidators.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Data/ObservedTriangles.h"
#include "Data/ViewBlocks.h"
#include "Output/Picture.h"
#include "Output/SurfaceFiles.h"
#include "Output/Viewpoint.h"
#include "Session/Session.h"

#include <vtkCameraReader.h>
#include <vtkCellData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace freespace
{

namespace
{

struct Settings
{
  std::string mesh;
  std::string output;
  std::string scene;
  std::string model;
  std::string view;
  std::string size;
  PictureLook look;
  CLI::Option* azimuth = nullptr;
  CLI::Option* elevation = nullptr;
  bool observed = false;
};

// "1920x1080" -> width and height.
std::array<int, 2> SizeFrom(const std::string& text)
{
  const std::size_t cross = std::min(text.find('x'), text.size());
  const std::string_view all(text);
  const std::array<int, 2> size = { ParseNumber<int>(all.substr(0, cross)).value_or(0),
    ParseNumber<int>(all.substr(std::min(cross + 1, all.size()))).value_or(0) };
  if (std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > 8192)
  {
    throw Error(
      "'" + text + "' is no size of a picture: it is WIDTHxHEIGHT, 1 to 8192 pixels each.");
  }
  return size;
}

std::string SizeFault(const std::string& text)
{
  try
  {
    SizeFrom(text);
    return "";
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

void AddOptions(CLI::App& command, Settings& settings)
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
                  ->type_name("SCENE.json");
  auto* model =
    command.add_option("--model", settings.model, "The same for the cameras of a COLMAP model")
      ->type_name("FOLDER")
      ->excludes(scene);
  auto* view =
    command.add_option("--view", settings.view, "The image whose camera it is")->type_name("NAME");
  const auto addWithoutCamera = [&](CLI::Option* option)
  { option->excludes(scene)->excludes(model)->excludes(view)->group("Without a camera"); };
  addWithoutCamera(command.add_option("--size", settings.size, "Size of the picture, pixels")
                     ->check(CLI::Validator(SizeFault, ""))
                     ->type_name("WIDTHxHEIGHT [1280x960]"));
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
}

vtkSmartPointer<vtkPolyData> FindView(
  Session& session, const Settings& settings, vtkPolyData* surface)
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

void Render(Session& session, const Settings& settings)
{
  const auto surface = ReadSurface(session, settings.mesh);
  if (settings.observed)
  {
    LeaveOutUnseen(surface, settings.mesh);
  }
  PictureLook look = settings.look;
  look.useViewpoint = settings.azimuth->count() == 0 && settings.elevation->count() == 0;
  if (!settings.size.empty())
  {
    look.size = SizeFrom(settings.size);
  }
  WritePicture(session, surface, FindView(session, settings, surface), look, settings.output);
}

}

void AddRenderCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command = program.add_subcommand("render", "Make a picture of a surface");
  AddOptions(*command, *settings);
  command->footer("Examples:\n"
                  "  freespace render mesh.ply -o mesh.png --azimuth 30 --elevation 60\n"
                  "  freespace render mesh.ply -o mesh.png --scene scene.json\n"
                  "  freespace render mesh.ply -o mesh.png --scene scene.json --view c.jpg");
  command->callback(session.Defer([settings, &session]() { Render(session, *settings); }));
}

}
