// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkClusterProposal.h>
#include <vtkNew.h>
#include <vtkSparseModelReader.h>

#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

struct Settings
{
  std::string scene;
  std::string images;
  std::string output;
  double preferredAngle = 5;
  double minimumOverlap = 0.4;
  double separation = 5;
};

void AddOptions(CLI::App& command, Settings& settings)
{
  command.add_option("scene", settings.scene, "The scene.json, or a structure-from-motion model")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command.add_option("--images", settings.images, "The folder of a model's photographs")
    ->check(CLI::ExistingDirectory)
    ->type_name("IMAGES");
  command.add_option("-o,--output", settings.output, "Write the scene with these clusters")
    ->type_name("OUT.json");
  command.add_option("--angle", settings.preferredAngle, "Best angle between neighbours, degrees")
    ->check(Positive())
    ->capture_default_str();
  command
    .add_option("--overlap", settings.minimumOverlap,
      "Least part of the reference's picture that a neighbour must see")
    ->check(CLI::Range(0.0, 1.0))
    ->capture_default_str();
  command
    .add_option("--separation", settings.separation,
      "Of references nearer than this keep one, degrees; 0 keeps all")
    ->check(NonNegative())
    ->capture_default_str();
}

void ProposeClusters(Session& session, const Settings& settings)
{
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
  proposal->SetPreferredAngle(settings.preferredAngle);
  proposal->SetMinimumOverlap(settings.minimumOverlap);
  proposal->SetSeparation(settings.separation);
  proposal->Propose();
  session.ThrowIfFailed();
  if (!settings.output.empty())
  {
    proposal->WriteScene(settings.output);
    session.ThrowIfFailed();
  }
  std::cout << proposal->GetText();
}

}

void AddClustersCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
    program.add_subcommand("clusters", "Choose the clusters of images, print and save the choice");
  AddOptions(*command, *settings);
  command->footer("Example:\n  freespace clusters scene.json -o scene-with-clusters.json\n"
                  "  freespace clusters colmap/sparse/0 --images colmap/images -o scene.json");
  command->callback(session.Defer([settings, &session]() { ProposeClusters(session, *settings); }));
}

}
