// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Files/PathChecks.h"
#include "Output/ViewFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Options/UnionOptions.h"
#include "Text/NumberTable.h"

#include <vtkDoubleArray.h>
#include <vtkFreespaceUnion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

namespace freespace
{

namespace
{

struct QuerySettings
{
  std::string maps;
  std::string points;
  std::string segments;
  std::string outside = "unknown";
  UnionOptions freeSpace;
};

// Rows of this many numbers, separated by commas or blanks, with an optional header.
std::vector<double> ReadTable(Session& session, const std::string& name, std::size_t columns)
{
  const bool isStandardInput = name == "-";
  const std::string fileName = isStandardInput ? "the standard input" : name;
  std::ifstream opened;
  if (!isStandardInput)
  {
    opened.open(name);
  }
  std::istream& file = isStandardInput ? std::cin : opened;
  if (!file || (!isStandardInput && IsFolder(fileName)))
  {
    throw Error("'" + fileName + "' cannot be read" + (file ? ": it is a folder." : "."));
  }
  return ReadNumberTable(file, fileName, columns, [&session] { session.ThrowIfFailed(); });
}

void TellPoints(Session& session, vtkFreespaceUnion* phi, const QuerySettings& settings)
{
  const std::vector<double> numbers = ReadTable(session, settings.points, 3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < numbers.size(); i += 3)
  {
    points->InsertNextPoint(&numbers[i]);
  }
  vtkNew<vtkUnsignedCharArray> states;
  session.Watch(phi, "query", [&] { phi->GetPointStates(points, states); });
  const char* const answers[] = { "0", "1", settings.outside == "free" ? "1" : "unknown" };
  std::cout << "free\n";
  for (vtkIdType i = 0; i < states->GetNumberOfValues(); ++i)
  {
    std::cout << answers[states->GetValue(i)] << "\n";
  }
}

void TellSegments(Session& session, vtkFreespaceUnion* phi, const std::string& fileName)
{
  const std::vector<double> numbers = ReadTable(session, fileName, 6);
  vtkNew<vtkPoints> first, last;
  first->SetDataTypeToDouble();
  last->SetDataTypeToDouble();
  for (std::size_t i = 0; i < numbers.size(); i += 6)
  {
    first->InsertNextPoint(&numbers[i]);
    last->InsertNextPoint(&numbers[i + 3]);
  }
  vtkNew<vtkDoubleArray> fractions;
  session.Watch(phi, "query", [&] { phi->FirstBlocked(first, last, fractions); });
  std::cout << "first_blocked\n";
  std::cout.precision(10);
  for (vtkIdType i = 0; i < fractions->GetNumberOfValues(); ++i)
  {
    std::cout << fractions->GetValue(i) << "\n";
  }
}

}

void AddQueryCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<QuerySettings>();
  CLI::App* command =
    program.add_subcommand("query", "Query which points and segments lie in free space");
  command->add_option("maps", settings->maps, "What 'triangulate' wrote")
    ->required()
    ->type_name("MAPS.vtm");
  auto* points = command
                   ->add_option("--points", settings->points,
                     "Rows x,y,z; - reads the standard input; prints 1 for each that is free, 0 in "
                     "matter, unknown "
                     "outside of the features' hull where no view has seen it")
                   ->type_name("FILE.csv");
  auto* segments =
    command
      ->add_option("--segments", settings->segments,
        "Rows x0,y0,z0,x1,y1,z1, or -; prints where each first leaves free space, as a "
        "fraction of it; inf: nowhere")
      ->type_name("FILE.csv");
  points->excludes(segments);
  command
    ->add_option("--outside", settings->outside,
      "What points outside of the hull are that no view has seen; free is the paper's Phi'")
    ->check(CLI::IsMember({ "unknown", "free" }))
    ->capture_default_str();
  settings->freeSpace.AddTo(*command);
  command->footer("Example:\n  freespace query maps.vtm --segments path.csv > blocked.csv\n"
                  "  grep -v '^#' path.xyz | freespace query maps.vtm --points -");
  command->callback(session.Defer(
    [settings, &session]()
    {
      if (settings->points.empty() && settings->segments.empty())
      {
        throw Error("There is nothing to ask: give --points or --segments.");
      }
      vtkNew<vtkFreespaceUnion> phi;
      phi->SetMaps(ReadMaps(session, settings->maps));
      settings->freeSpace.SetUp(phi.Get());
      session.Watch(phi, "build", [&] { phi->Update(); });
      settings->points.empty() ? TellSegments(session, phi, settings->segments)
                               : TellPoints(session, phi, *settings);
    }));
}

}
