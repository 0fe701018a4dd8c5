// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/SurfaceFiles.h"
#include "Session/Session.h"
#include "Options/ClusterChoice.h"

#include <vtkClusterProposal.h>
#include <vtkNew.h>
#include <vtkSparseModelReader.h>

#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

struct ClustersSettings
{
  std::string scene;
  std::string images;
  std::string output;
  ClusterChoice clusters;
};

void AddOptions(CLI::App& command, ClustersSettings& settings)
{
  command.add_option("scene", settings.scene, "The scene.json, or a structure-from-motion model")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command.add_option("--images", settings.images, "The folder of a model's images")
    ->check(CLI::ExistingDirectory)
    ->type_name("IMAGES");
  command.add_option("-o,--output", settings.output, "Write the scene with these clusters")
    ->type_name("OUT.json");
  settings.clusters.AddOptions(command, "Clusters");
}

void ProposeClusters(Session& session, const ClustersSettings& settings)
{
  if (!settings.output.empty())
  {
    CheckOutputFolder(settings.output);
  }
  vtkNew<vtkClusterProposal> proposal;
  if (vtkSparseModelReader::CanReadFile(settings.scene))
  {
    proposal->SetModel(settings.scene);
    proposal->SetImages(settings.images);
  }
  else
  {
    proposal->SetFileName(settings.scene);
  }
  settings.clusters.Apply(proposal);
  proposal->Propose();
  session.ThrowIfFailed();
  if (!settings.output.empty())
  {
    proposal->WriteScene(settings.output);
    session.ThrowIfFailed();
    session.Log("wrote " + settings.output);
  }
  std::cout << proposal->GetText() << proposal->GetSummary() << "\n";
}

}

void AddClustersCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ClustersSettings>();
  CLI::App* command =
    program.add_subcommand("clusters", "Choose the clusters of images, print and save the choice");
  AddOptions(*command, *settings);
  command->footer("Example:\n  freespace clusters scene.json -o scene-with-clusters.json\n"
                  "  freespace clusters colmap/sparse/0 --images colmap/images -o scene.json");
  command->callback(session.Defer([settings, &session]() { ProposeClusters(session, *settings); }));
}

}
