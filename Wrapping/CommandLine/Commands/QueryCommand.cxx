// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Output/ViewFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Stages/UnionOptions.h"

#include <vtkDoubleArray.h>
#include <vtkFreespaceUnion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

namespace freespace
{

namespace
{

struct Settings
{
  std::string maps;
  std::string points;
  std::string segments;
  std::string outside = "unknown";
  UnionOptions freeSpace;
};

// Whether a first row names the columns: it has a letter and does not begin like a number, such as
// "1e3,0,0" or "1;2;3e5".
bool IsHeading(const std::string& line)
{
  const std::size_t begin = std::min(line.find_first_not_of(" \t+"), line.size());
  const char* end = line.data() + line.size();
  double number = 0;
  return std::from_chars(line.data() + begin, end, number).ec == std::errc::invalid_argument &&
    std::any_of(line.begin(), line.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

// The numbers of a row; nothing when it has anything else.
std::vector<double> ReadRow(std::string line)
{
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<double> values;
  for (std::string word; words >> word;)
  {
    const std::optional<double> value = ParseNumber<double>(word);
    if (!value || !std::isfinite(*value))
    {
      return {};
    }
    values.push_back(*value);
  }
  return values;
}

// The next line. Throws Error where it is too long for numbers, as the one of /dev/zero, which does not end.
bool NextLine(std::istream& file, const std::string& fileName, std::string& line)
{
  constexpr std::size_t longest = 1 << 16;
  line.clear();
  for (int c = file.get(); c != '\n'; c = file.get())
  {
    if (c == std::istream::traits_type::eof())
    {
      return !line.empty();
    }
    line += static_cast<char>(c);
    if (line.size() > longest)
    {
      throw Error("'" + fileName + "' is no table of numbers: one of its lines is too long.");
    }
  }
  return true;
}

// Rows of so many numbers, parted by commas or blanks, perhaps below a heading.
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
  if (!file || (!isStandardInput && std::filesystem::is_directory(fileName)))
  {
    throw Error("'" + fileName + "' cannot be read" + (file ? ": it is a folder." : "."));
  }
  std::vector<double> numbers;
  std::string line;
  bool isFirst = true;
  for (int row = 1; NextLine(file, fileName, line); ++row)
  {
    session.ThrowIfFailed();                            // on an interrupt
    if (row == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) // a byte order mark
    {
      line.erase(0, 3);
    }
    if (line.find_first_not_of(" \t\r") == std::string::npos)
    {
      continue;
    }
    const bool isHeading = isFirst && IsHeading(line);
    isFirst = false;
    if (isHeading)
    {
      continue;
    }
    const std::vector<double> values = ReadRow(line);
    if (values.size() != columns)
    {
      throw Error("'" + fileName + "' has no " + std::to_string(columns) + " numbers in line " +
        std::to_string(row) + ".");
    }
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  if (isFirst)
  {
    throw Error("'" + fileName + "' is empty: there is no line 1.");
  }
  return numbers;
}

void TellPoints(Session& session, vtkFreespaceUnion* phi, const Settings& settings)
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
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
    program.add_subcommand("query", "Ask which points and segments lie in free space");
  command->add_option("maps", settings->maps, "What 'triangulate' wrote")
    ->required()
    ->type_name("MAPS.vtm");
  auto* points = command
                   ->add_option("--points", settings->points,
                     "Rows x,y,z; - reads the standard input; tells 1 for each that is free, 0 in "
                     "matter, unknown "
                     "outside of the features' hull where no view has seen it")
                   ->type_name("FILE.csv");
  auto* segments =
    command
      ->add_option("--segments", settings->segments,
        "Rows x0,y0,z0,x1,y1,z1, or -; tells where each first leaves free space, as a "
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
