// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/ViewFiles.h"
#include "Session/Session.h"
#include "Stages/SparseStage.h"

#include <vtkMultiBlockDataSet.h>

#include <memory>

namespace freespace
{

namespace
{

struct SparseSettings
{
  std::string model;
  std::string output;
  SparseStage sparse;
};

}

void AddSparseCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<SparseSettings>();
  CLI::App* command =
    program.add_subcommand("sparse", "Take features from a structure-from-motion model");
  command
    ->add_option("model", settings->model,
      "A folder with COLMAP's files, or a file of another program: .nvm, .out, .sfm, sfm_data.json")
    ->required()
    ->type_name("MODEL");
  command->add_option("-o,--output", settings->output, "The features to write")
    ->required()
    ->type_name("FEATURES.vtm");
  settings->sparse.AddOptions(*command);
  command->footer("Example:\n  freespace sparse colmap/sparse/0 -o features.vtm");
  command->callback(session.Defer(
    [settings, &session]()
    {
      CheckViewsName(settings->output);
      WriteViews(session, settings->sparse.Run(session, settings->model), settings->output);
    }));
}

}
