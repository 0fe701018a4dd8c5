// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/SilhouetteBlocks.h"
#include "Export/FeatureExport.h"
#include "Output/SurfaceFiles.h"
#include "Output/ViewFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Tables/ResultFile.h"

#include <vtkCameraReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <memory>

namespace freespace
{

namespace
{

struct ExportSettings
{
  std::string input;
  std::string output;
  std::string what;
  double depth = 0;
};

struct Kind
{
  const char* name;
  std::vector<std::string> endings;
};

const Kind& KindOf(const std::string& name)
{
  static const Kind kinds[] = { { "features", { ".ply", ".csv", ".vtp", ".obj" } },
    { "chains", { ".vtp", ".obj" } }, { "cameras", { ".ply", ".vtp", ".obj", ".stl" } } };
  return *std::find_if(
    std::begin(kinds), std::end(kinds), [&name](const Kind& kind) { return kind.name == name; });
}

void CheckEnding(const Kind& kind, const std::string& output)
{
  const std::string ending = LowerCaseExtension(output);
  if (std::find(kind.endings.begin(), kind.endings.end(), ending) == kind.endings.end())
  {
    std::string all;
    for (const std::string& known : kind.endings)
    {
      all += (all.empty() ? "" : " ") + known;
    }
    throw Error("Cannot write '" + output + "': " + kind.name + " are written as " + all + ".");
  }
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadCameras(Session& session, const std::string& input)
{
  if (LowerCaseExtension(input) == ".vtm")
  {
    return ReadViews(session, input);
  }
  vtkNew<vtkCameraReader> reader;
  reader->SetFileName(input);
  session.Run(reader, "cameras");
  return reader->GetOutput();
}

void Export(Session& session, const ExportSettings& settings)
{
  const bool isViews = LowerCaseExtension(settings.input) == ".vtm";
  const std::string what = !settings.what.empty() ? settings.what
    : isViews                                     ? "features"
                                                  : "cameras";
  if (settings.what.empty() && !isViews && LowerCaseExtension(settings.output) == ".csv")
  {
    throw Error("Cannot write '" + settings.output + "': a .csv holds features, and '" +
      settings.input + "' is no .vtm that has some.");
  }
  CheckEnding(KindOf(what), settings.output);
  CheckOutputFolder(settings.output);
  if (what == "cameras")
  {
    WriteSurface(
      session, Frusta(ReadCameras(session, settings.input), settings.depth), settings.output);
    return;
  }
  const auto views = WithoutSilhouettes(ReadViews(session, settings.input));
  if (LowerCaseExtension(settings.output) == ".csv")
  {
    WriteResult(settings.output, FeatureRows(views));
    session.Log("wrote " + settings.output);
    return;
  }
  const auto exported = what == "chains" ? FeatureChains(views) : FeaturePoints(views);
  if (exported->GetNumberOfPoints() == 0)
  {
    throw Error("'" + settings.input + "' has no " + what + ".");
  }
  WriteSurface(session, exported, settings.output);
}

}

void AddExportCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ExportSettings>();
  CLI::App* command =
    program.add_subcommand("export", "Write features, their chains or cameras for other programs");
  command
    ->add_option(
      "input", settings->input, "Features or disparity maps (.vtm), a scene.json or a camera model")
    ->required()
    ->type_name("INPUT");
  command
    ->add_option("-o,--output", settings->output,
      "The file to write: .ply .csv .vtp .obj of features, .vtp .obj of chains, .ply .vtp .obj "
      ".stl "
      "of cameras")
    ->required()
    ->type_name("OUT.ply");
  command
    ->add_option("--what", settings->what,
      "What is written; chains are the polylines of features that an image edge joins, cameras are "
      "pyramids (default: features of a .vtm, else cameras)")
    ->check(CLI::IsMember({ "features", "chains", "cameras" }))
    ->type_name("features|chains|cameras");
  command
    ->add_option("--depth", settings->depth,
      "Length of the cameras' pyramids in the scene's unit; 0: as their distances suggest")
    ->check(NonNegative())
    ->capture_default_str();
  command->footer("Examples:\n"
                  "  freespace export features.vtm -o features.csv\n"
                  "  freespace export features.vtm --what chains -o chains.obj\n"
                  "  freespace export scene.json -o cameras.ply");
  command->callback(session.Defer([settings, &session]() { Export(session, *settings); }));
}

}
