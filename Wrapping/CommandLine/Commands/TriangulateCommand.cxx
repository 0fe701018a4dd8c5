// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/ViewFiles.h"
#include "Session/Session.h"
#include "Stages/TriangulateStage.h"

#include <vtkMultiBlockDataSet.h>

#include <memory>

namespace freespace
{

namespace
{

struct TriangulateSettings
{
  std::string features;
  std::string output;
  TriangulateStage triangulate;
};

// All processes read the features for themselves.
void Triangulate(Session& session, const TriangulateSettings& settings)
{
  if (session.IsWriter())
  {
    CheckViewsName(settings.output);
  }
  const auto features = ReadFeatures(session, settings.features);
  const auto maps = settings.triangulate.Run(session, features);
  if (session.MayWrite())
  {
    WriteViews(session, maps, settings.output);
  }
}

}

void AddTriangulateCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<TriangulateSettings>();
  CLI::App* command =
    program.add_subcommand("triangulate", "Make a disparity map of each view's features");
  command->add_option("features", settings->features, "What 'stereo' wrote")
    ->required()
    ->type_name("FEATURES.vtm");
  command->add_option("-o,--output", settings->output, "The disparity maps to write")
    ->required()
    ->type_name("MAPS.vtm");
  settings->triangulate.AddOptions(*command);
  command->footer("Example:\n  freespace triangulate features.vtm -o maps.vtm\n"
                  "  mpiexec -n 4 freespace triangulate features.vtm -o maps.vtm");
  command->callback(session.Defer(
    [settings, &session]() { Triangulate(session, *settings); }, Session::Sharing::AllProcesses));
}

}
