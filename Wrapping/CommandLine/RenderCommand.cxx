// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "Error.h"
#include "Picture.h"
#include "Session.h"
#include "Stages.h"

#include <vtkCameraReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

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
};

void AddOptions(CLI::App& command, Settings& settings)
{
  command.add_option("mesh", settings.mesh, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command.add_option("-o,--output", settings.output, "The picture to write")
    ->required()
    ->type_name("OUT.png");
  auto* scene =
    command.add_option("--scene", settings.scene, "The scene whose camera to look from")
      ->type_name("SCENE.json");
  auto* model =
    command.add_option("--model", settings.model, "The COLMAP model whose camera to look from")
      ->type_name("FOLDER")
      ->excludes(scene);
  auto* view =
    command.add_option("--view", settings.view, "The image whose camera it is")->type_name("NAME");
  scene->needs(view);
  model->needs(view);
}

void Render(Session& session, const Settings& settings)
{
  vtkNew<vtkCameraReader> cameras;
  vtkSmartPointer<vtkPolyData> view;
  const std::string& source = settings.scene.empty() ? settings.model : settings.scene;
  if (!source.empty())
  {
    cameras->SetFileName(source);
    session.Run(cameras, "cameras");
    view = cameras->GetView(settings.view);
    if (!view)
    {
      throw Error(source + " has no image '" + settings.view + "'.");
    }
  }
  else if (!settings.view.empty())
  {
    throw Error("--view names a camera of --scene or --model: give one of them.");
  }
  const auto surface = ReadSurface(session, settings.mesh);
  WritePicture(session, surface, view, settings.output);
}

}

void AddRenderCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command = program.add_subcommand("render", "Make a picture of a surface");
  AddOptions(*command, *settings);
  command->footer("Examples:\n"
                  "  freespace render mesh.ply -o mesh.png\n"
                  "  freespace render mesh.ply -o mesh.png --scene scene.json --view c.jpg");
  command->callback(session.Later([settings, &session]() { Render(session, *settings); }));
}

}
