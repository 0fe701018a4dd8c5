// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Depth/DepthFeatures.h"
#include "Output/ViewFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkDepthMapReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <memory>

namespace freespace
{

namespace
{

struct DepthSettings
{
  std::vector<std::string> maps;
  std::string scene;
  std::string output;
  DepthOptions depth;
};

void AddOptions(CLI::App& command, DepthSettings& settings)
{
  DepthOptions& depth = settings.depth;
  command
    .add_option("maps", settings.maps,
      "The depth maps, named after their images: COLMAP's .bin, .pfm, or .png of 16 bits")
    ->required()
    ->type_name("MAPS");
  command
    .add_option("--scene", settings.scene, "The scene, or the model, with the images' cameras")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command.add_option("-o,--output", settings.output, "The features to write")
    ->required()
    ->type_name("FEATURES.vtm");
  command
    .add_option("--scale", depth.scale,
      "The scene's unit for each unit of the maps, for instance 0.001 for millimetres")
    ->check(Positive())
    ->capture_default_str();
  command.add_flag(
    "--range", depth.isRange, "The maps hold distances from the camera, not along its axis");
  command.add_option("--near", depth.nearest, "Nearest depth that is used, in the scene's unit")
    ->check(NonNegative())
    ->capture_default_str();
  command.add_option("--far", depth.farthest, "Farthest depth that is used; 0: no limit")
    ->check(NonNegative())
    ->capture_default_str();
  command
    .add_option("--deviation", depth.deviation,
      "Standard deviation of depths in the scene's unit, to which --relative-deviation is added")
    ->check(NonNegative())
    ->capture_default_str();
  command
    .add_option("--relative-deviation", depth.relativeDeviation,
      "Standard deviation of depths as a part of them")
    ->check(NonNegative())
    ->capture_default_str();
  command
    .add_option("--tolerance", depth.tolerance,
      "How far depths may be off the planes between features, in deviations")
    ->check(NonNegative())
    ->capture_default_str();
  command
    .add_option("--block", depth.largestBlock,
      "Side of the largest block of pixels whose corners stand for it; 1: each pixel is a feature")
    ->check(CLI::Range(1, 1024))
    ->capture_default_str();
}

void Depth(Session& session, const DepthSettings& settings)
{
  CheckViewsName(settings.output);
  vtkNew<vtkDepthMapReader> reader;
  reader->SetFileName(settings.scene);
  for (const std::string& map : settings.maps)
  {
    reader->AddDepthFile(map);
  }
  reader->SetScale(settings.depth.scale);
  reader->SetIsRange(settings.depth.isRange);
  reader->SetNearestDepth(settings.depth.nearest);
  reader->SetFarthestDepth(settings.depth.farthest);
  reader->SetDeviation(settings.depth.deviation);
  reader->SetRelativeDeviation(settings.depth.relativeDeviation);
  reader->SetTolerance(settings.depth.tolerance);
  reader->SetLargestBlock(settings.depth.largestBlock);
  session.Run(reader, "depth");
  vtkMultiBlockDataSet* features = reader->GetOutput();
  session.Log("depth: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  WriteViews(session, features, settings.output);
}

}

void AddDepthCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<DepthSettings>();
  CLI::App* command =
    program.add_subcommand("depth", "Make the pixels of depth maps and range images features");
  AddOptions(*command, *settings);
  command->footer(
    "Examples:\n"
    "  freespace depth dense/stereo/depth_maps/*.geometric.bin --scene dense -o features.vtm\n"
    "  freespace depth rgbd/*.png --scale 0.001 --scene transforms.json -o features.vtm");
  command->callback(session.Defer([settings, &session]() { Depth(session, *settings); }));
}

}
