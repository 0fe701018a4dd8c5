// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/ViewBlocks.h"
#include "Files/FileNames.h"
#include "Files/PathChecks.h"
#include "Output/Animation.h"
#include "Output/NewFolder.h"
#include "Output/PictureOptions.h"
#include "Output/SurfaceFiles.h"
#include "Output/Viewpoint.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Viewpoints/Turntable.h"

#include <vtkCameraReader.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPhotographReader.h>
#include <vtkPolyData.h>
#include <vtkSurfacePicture.h>
#include <vtkViewDependentTextureMapper.h>

#include <filesystem>
#include <memory>
#include <set>

namespace freespace
{

namespace
{

namespace fs = std::filesystem;

struct ViewSettings
{
  std::string scene;
  std::string mesh;
  std::string output;
  std::string view;
  std::string model;
  int turntable = 0;
  int rate = 12;
  PictureOptions picture;

  bool IsFilm() const { return this->turntable > 0 && Animation::CanWriteFile(this->output); }
  bool IsFolder() const { return !this->model.empty() || (this->turntable > 0 && !this->IsFilm()); }
};

void AddOptions(CLI::App& command, ViewSettings& settings)
{
  command
    .add_option("scene", settings.scene,
      "The scene whose images colour the surface, or a model with a folder images "
      "beside it or above")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command.add_option("--mesh", settings.mesh, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command
    .add_option("-o,--output", settings.output,
      "The picture to write, or the folder of pictures for --model and --turntable, or for "
      "--turntable a film, .ogv")
    ->required()
    ->type_name("OUT");
  auto* from = command.add_option_group(
    "viewpoint", "The viewpoint; default: close to the cameras, with all of the surface in sight");
  from->add_option("--view", settings.view, "The camera of this image of the scene")
    ->type_name("NAME");
  from->add_option("--model", settings.model, "Each camera of this model")->type_name("MODEL");
  from->add_option("--turntable", settings.turntable, "Number of cameras around the scene")
    ->check(Positive())
    ->type_name("N");
  from->require_option(0, 1);
  settings.picture.AddSize(command);
  command.add_option("--rate", settings.rate, "Pictures a second of a film")
    ->check(CLI::Range(1, 240))
    ->capture_default_str();
}

/// A camera to look from, and the file to write.
struct Shot
{
  vtkSmartPointer<vtkPolyData> view;
  std::string fileName;
};

std::vector<Shot> ShotsOfModel(vtkMultiBlockDataSet* cameras, const fs::path& folder)
{
  std::vector<std::string> images;
  for (unsigned int i = 0; i < cameras->GetNumberOfBlocks(); ++i)
  {
    images.push_back(BlockName(cameras, i));
  }
  const std::vector<std::string> names = DistinctFileNames(images);
  std::vector<Shot> shots;
  for (unsigned int i = 0; i < cameras->GetNumberOfBlocks(); ++i)
  {
    shots.push_back(
      { vtkPolyData::SafeDownCast(cameras->GetBlock(i)), (folder / (names[i] + ".png")).string() });
  }
  return shots;
}

std::vector<Shot> ShotsOfTurntable(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const ViewSettings& settings)
{
  std::vector<Camera> known;
  std::vector<Eigen::Vector3d> points;
  for (const View& view : ViewsOfSurface(cameras, surface, settings.scene))
  {
    known.push_back(view.camera);
    points.insert(points.end(), view.points.begin(), view.points.end());
  }
  const int count = settings.turntable;
  const fs::path folder = settings.output;
  std::vector<Shot> shots;
  for (const Camera& camera : TurntableCameras(known, count, points))
  {
    View view;
    view.camera = camera;
    std::string number = std::to_string(shots.size());
    number.insert(0, std::to_string(count - 1).size() - number.size(), '0');
    shots.push_back({ BlockFromView(view), (folder / (number + ".png")).string() });
  }
  return shots;
}

Shot ShotOfDefault(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const ViewSettings& settings)
{
  View view;
  view.camera = ViewpointOfCameras(cameras, surface, settings.scene);
  return { BlockFromView(view), settings.output };
}

std::vector<Shot> FindShots(Session& session, vtkPolyData* surface, const ViewSettings& settings)
{
  vtkNew<vtkCameraReader> cameras;
  cameras->SetFileName(settings.model.empty() ? settings.scene : settings.model);
  session.Run(cameras, "cameras");
  if (!settings.view.empty())
  {
    vtkPolyData* view = cameras->GetView(settings.view);
    if (!view)
    {
      throw Error(settings.scene + " has no image '" + settings.view + "'.");
    }
    return { { view, settings.output } };
  }
  if (settings.turntable > 0)
  {
    return ShotsOfTurntable(cameras->GetOutput(), surface, settings);
  }
  return settings.model.empty()
    ? std::vector<Shot>{ ShotOfDefault(cameras->GetOutput(), surface, settings) }
    : ShotsOfModel(cameras->GetOutput(), settings.output);
}

void TellViews(Session& session, vtkViewDependentTextureMapper* mapper, unsigned int photographs)
{
  const int inUse = mapper->GetNumberOfViewsInUse();
  session.Log("colours from " + std::to_string(inUse) + " of " + std::to_string(photographs) +
    " images" + (inUse < int(photographs) ? ", the best for this camera" : ""));
}

// Whether a folder's name is that of a film or a picture, which must be meant.
bool LooksLikeAFile(const std::string& folder)
{
  const std::set<std::string> endings = { ".avi", ".flv", ".gif", ".jpeg", ".jpg", ".m4v", ".mkv",
    ".mov", ".mp4", ".mpeg", ".mpg", ".ogg", ".ogv", ".png", ".webm", ".webp", ".wmv" };
  return !IsFolder(folder) && endings.count(LowerCaseExtension(folder)) > 0;
}

void CheckOutput(const ViewSettings& settings)
{
  if (settings.IsFilm())
  {
    CheckOutputFolder(settings.output);
  }
  else if (!settings.IsFolder())
  {
    CheckPictureName(settings.output);
  }
  else if (LooksLikeAFile(settings.output))
  {
    throw Error("Cannot write '" + settings.output + "': " +
      (settings.turntable > 0 ? "a turntable makes a film, whose name ends in .ogv, or a folder of "
                                "pictures."
                              : "--model makes a folder of pictures."));
  }
}

void ViewScene(Session& session, const ViewSettings& settings)
{
  CheckOutput(settings);
  const auto surface = ReadSurface(session, settings.mesh);
  const std::vector<Shot> shots = FindShots(session, surface, settings);
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(settings.scene);
  session.Run(photographs, "images");
  const auto folder = settings.IsFolder() ? std::make_unique<NewFolder>(settings.output) : nullptr;
  const auto film =
    settings.IsFilm() ? std::make_unique<Animation>(settings.output, settings.rate) : nullptr;
  vtkNew<vtkViewDependentTextureMapper> mapper;
  mapper->SetPhotographs(photographs->GetOutput());
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(surface);
  picture->SetMapper(mapper);
  picture->SetSamples(1); // the mapper samples edges by itself
  for (const Shot& shot : shots)
  {
    picture->SetViewBlock(Resized(shot.view, settings.picture.Size()));
    session.Run(picture, fs::path(shot.fileName).filename().string());
    if (film)
    {
      film->Add(session, picture->GetOutput());
    }
    else
    {
      picture->WritePNG(shot.fileName);
      session.ThrowIfFailed();
    }
    TellViews(session, mapper, photographs->GetOutput()->GetNumberOfBlocks());
  }
  if (film)
  {
    film->Finish(session);
  }
  session.Log((folder ? "wrote the pictures in " : "wrote ") + settings.output);
}

}

void AddViewCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ViewSettings>();
  CLI::App* command =
    program.add_subcommand("view", "Make pictures of a surface in the colours of the images");
  AddOptions(*command, *settings);
  command->footer("Examples:\n"
                  "  freespace view scene.json --mesh mesh.ply -o view.png\n"
                  "  freespace view scene.json --mesh mesh.ply --view c.jpg -o c.png\n"
                  "  freespace view scene.json --mesh mesh.ply --model novel -o pictures\n"
                  "  freespace view scene.json --mesh mesh.ply --turntable 36 -o pictures\n"
                  "  freespace view scene.json --mesh mesh.ply --turntable 72 -o turn.ogv");
  command->callback(session.Defer([settings, &session]() { ViewScene(session, *settings); }));
}

}
