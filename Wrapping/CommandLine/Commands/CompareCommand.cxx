// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Mesh/Distance/SurfaceComparison.h"
#include "Output/SurfaceFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Tables/ResultFile.h"
#include "Tables/TextTable.h"

#include <vtkDataArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSurfaceComparison.h>
#include <vtkUnsignedCharArray.h>

#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

struct CompareSettings
{
  std::string surface;
  std::string reference;
  SurfaceComparisonOptions options;
  std::string json;
  std::string histogram;
  std::string output;
  std::string referenceOutput;
};

constexpr int Directions[] = { vtkSurfaceComparison::SurfaceToReference,
  vtkSurfaceComparison::ReferenceToSurface };

void AddOptions(CLI::App& command, CompareSettings& settings)
{
  command.add_option("mesh", settings.surface, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command.add_option("reference", settings.reference, "The true surface, in the same coordinates")
    ->required()
    ->type_name("REFERENCE.ply");
  command
    .add_option("--distances", settings.options.limits,
      "Distances d1,d2,... at which accuracy, completeness and F are reported, in the surfaces' "
      "unit "
      "(default: 0.1, 0.2 and 0.5 % of the reference's diagonal)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(Positive())
    ->type_name("NUMBERS");
  command
    .add_option("--samples", settings.options.samples,
      "Random points of each surface, evenly by area, the same in each run; 0: its vertices")
    ->check(CLI::Range(0, 100000000))
    ->capture_default_str();
  command
    .add_option("--json", settings.json, "Write the figures as JSON; -: to the standard output")
    ->type_name("FILE.json");
  command
    .add_option("--histogram", settings.histogram,
      "Write the shares of the samples by distance, both ways; -: to the standard output")
    ->type_name("FILE.csv");
  command.add_option("--bins", settings.options.bins, "Bins of the histogram")
    ->check(CLI::Range(1, 100000))
    ->capture_default_str();
  command
    .add_option("-o,--output", settings.output,
      "Write the surface coloured by distance, blue where it is 0 and red from the greatest of "
      "--distances on; a .vtp has the distances, too")
    ->type_name("OUT.ply");
  command
    .add_option("--reference-output", settings.referenceOutput,
      "The same for the reference: what is missing is red")
    ->type_name("OUT.ply");
}

void Check(const CompareSettings& settings)
{
  for (const std::string& file : { settings.json, settings.histogram })
  {
    CheckResultFile(file);
  }
  for (const std::string& file : { settings.output, settings.referenceOutput })
  {
    if (!file.empty())
    {
      CheckSurfaceName(file);
    }
  }
}

std::string TextOf(vtkSurfaceComparison* comparison)
{
  using Getter = double (vtkSurfaceComparison::*)(int);
  const std::pair<const char*, Getter> figures[] = { { "mean distance",
                                                       &vtkSurfaceComparison::GetMeanDistance },
    { "root mean square", &vtkSurfaceComparison::GetRootMeanSquareDistance },
    { "median distance", &vtkSurfaceComparison::GetMedianDistance },
    { "greatest distance", &vtkSurfaceComparison::GetGreatestDistance },
    { "mean angle (degrees)", &vtkSurfaceComparison::GetMeanAngle },
    { "median angle", &vtkSurfaceComparison::GetMedianAngle } };
  TextTable both;
  both.Add({ "", "mesh to reference", "reference to mesh" });
  for (const auto& [name, get] : figures)
  {
    both.Add({ name, NumberText((comparison->*get)(Directions[0])),
      NumberText((comparison->*get)(Directions[1])) });
  }
  TextTable shares;
  shares.Add({ "distance", "accuracy", "completeness", "F" });
  const auto limits = comparison->GetUsedLimits(), accuracy = comparison->GetAccuracy(),
             completeness = comparison->GetCompleteness(), f = comparison->GetF();
  for (std::size_t i = 0; i < limits.size(); ++i)
  {
    shares.Add({ NumberText(limits[i]), NumberText(accuracy[i]), NumberText(completeness[i]),
      NumberText(f[i]) });
  }
  return both.Text() + "\n" + shares.Text();
}

nlohmann::ordered_json JsonOf(vtkSurfaceComparison* comparison, const CompareSettings& settings)
{
  nlohmann::ordered_json json;
  json["mesh"] = settings.surface;
  json["reference"] = settings.reference;
  for (int from : Directions)
  {
    auto& figures = json[from == vtkSurfaceComparison::SurfaceToReference ? "mesh_to_reference"
                                                                          : "reference_to_mesh"];
    figures["mean"] = comparison->GetMeanDistance(from);
    figures["root_mean_square"] = comparison->GetRootMeanSquareDistance(from);
    figures["median"] = comparison->GetMedianDistance(from);
    figures["greatest"] = comparison->GetGreatestDistance(from);
    figures["mean_angle"] = comparison->GetMeanAngle(from);
    figures["median_angle"] = comparison->GetMedianAngle(from);
    figures["histogram"] = comparison->GetHistogram(from);
  }
  json["distances"] = comparison->GetUsedLimits();
  json["accuracy"] = comparison->GetAccuracy();
  json["completeness"] = comparison->GetCompleteness();
  json["f"] = comparison->GetF();
  return json;
}

std::string HistogramText(vtkSurfaceComparison* comparison)
{
  const auto accuracy = comparison->GetHistogram(Directions[0]),
             completeness = comparison->GetHistogram(Directions[1]);
  const double greatest = comparison->GetUsedLimits().back();
  const std::size_t bins = accuracy.size() - 1;
  std::string text = "from,to,mesh_to_reference,reference_to_mesh\n";
  for (std::size_t i = 0; i <= bins; ++i)
  {
    text += NumberText(greatest * double(i) / double(bins), 10) + "," +
      (i < bins ? NumberText(greatest * double(i + 1) / double(bins), 10) : "inf") + "," +
      NumberText(accuracy[i], 10) + "," + NumberText(completeness[i], 10) + "\n";
  }
  return text;
}

// Colours of the points by the array Distance.
void Color(vtkPolyData* surface, double greatest)
{
  vtkNew<vtkLookupTable> colors;
  colors->SetHueRange(2.0 / 3, 0); // blue to red
  colors->SetRange(0, greatest);
  colors->Build();
  const auto rgb = vtkSmartPointer<vtkUnsignedCharArray>::Take(colors->MapScalars(
    surface->GetPointData()->GetArray("Distance"), VTK_COLOR_MODE_MAP_SCALARS, -1, VTK_RGB));
  rgb->SetName("RGB");
  surface->GetPointData()->AddArray(rgb);
}

void Compare(Session& session, const CompareSettings& settings)
{
  Check(settings);
  vtkNew<vtkSurfaceComparison> comparison;
  comparison->SetInputDataObject(0, ReadSurface(session, settings.surface));
  comparison->SetInputDataObject(1, ReadSurface(session, settings.reference));
  comparison->SetLimits(settings.options.limits);
  comparison->SetSamples(settings.options.samples);
  comparison->SetBins(settings.options.bins);
  session.Run(comparison, "compare");
  const double greatest = comparison->GetUsedLimits().back();
  const std::string files[] = { settings.output, settings.referenceOutput };
  for (int from : Directions)
  {
    if (!files[from].empty())
    {
      Color(comparison->GetOutput(from), greatest);
      WriteSurface(session, comparison->GetOutput(from), files[from]);
    }
  }
  if (!settings.histogram.empty())
  {
    WriteResult(settings.histogram, HistogramText(comparison));
  }
  if (!settings.json.empty())
  {
    WriteResult(settings.json, JsonOf(comparison, settings));
  }
  if (settings.json != "-" && settings.histogram != "-")
  {
    std::cout << TextOf(comparison);
  }
}

}

void AddCompareCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<CompareSettings>();
  CLI::App* command =
    program.add_subcommand("compare", "Compare a surface with a reference: distances both ways");
  AddOptions(*command, *settings);
  command->footer(
    "Accuracy is the share of the mesh that is nearer to the reference than a distance, "
    "completeness the share of the reference that is nearer to the mesh, F their harmonic mean.\n"
    "Examples:\n"
    "  freespace compare mesh.ply truth.ply\n"
    "  freespace compare mesh.ply truth.ply --distances 0.01,0.02 --json - -o errors.ply");
  command->callback(session.Defer([settings, &session]() { Compare(session, *settings); }));
}

}
