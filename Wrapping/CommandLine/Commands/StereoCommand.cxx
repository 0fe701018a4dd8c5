// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/NewFolder.h"
#include "Output/ViewFiles.h"
#include "Scene/Scene.h"
#include "Session/Session.h"
#include "Stages/StereoStage.h"

#include <vtkFeatureOverlayWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <memory>

namespace freespace
{

namespace
{

struct StereoSettings
{
  std::string scene;
  std::string output;
  std::string overlay;
  StereoStage stereo;
};

void FindFeatures(Session& session, const StereoSettings& settings)
{
  if (session.IsWriter())
  {
    CheckViewsName(settings.output);
  }
  const auto features = settings.stereo.Run(session, settings.scene);
  if (!session.MayWrite())
  {
    return;
  }
  WriteViews(session, features, settings.output);
  if (!settings.overlay.empty())
  {
    vtkNew<vtkFeatureOverlayWriter> overlay;
    overlay->SetInputDataObject(features);
    overlay->SetImagesFolder(ReadScene(settings.scene).ImagesFolder());
    overlay->SetOutputFolder(settings.overlay);
    const NewFolder folder(settings.overlay); // gone again if nothing comes into it
    session.Write(overlay);
    session.Log("wrote the pictures in " + settings.overlay);
  }
}

}

void AddStereoCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<StereoSettings>();
  CLI::App* command =
    program.add_subcommand("stereo", "Find the features of each cluster of images");
  command->add_option("scene", settings->scene, "The scene.json")
    ->required()
    ->type_name("SCENE.json");
  command->add_option("-o,--output", settings->output, "The features to write")
    ->required()
    ->type_name("FEATURES.vtm");
  command
    ->add_option("--overlay", settings->overlay,
      "Write each reference image with its features drawn over it, coloured by disparity")
    ->type_name("FOLDER");
  settings->stereo.AddOptions(*command);
  command->footer("Example:\n  freespace stereo scene.json -o features.vtm --overlay pictures\n"
                  "  mpiexec -n 4 freespace stereo scene.json -o features.vtm");
  command->callback(session.Defer(
    [settings, &session]() { FindFeatures(session, *settings); }, Session::Sharing::AllProcesses));
}

}
