// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Output/SurfaceFiles.h"
#include "Output/ViewFiles.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Options/GlobalShiftOption.h"
#include "Options/UnionOptions.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOccupancyMapWriter.h>

#include <memory>

#include <fcntl.h>
#include <unistd.h>

namespace freespace
{

namespace
{

/// Discards what is written to the standard error: OctoMap prints the number of nodes there and cannot be
/// silenced otherwise.
class SilentStandardError
{
public:
  SilentStandardError()
    : Kept(dup(STDERR_FILENO))
  {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~SilentStandardError()
  {
    dup2(this->Kept, STDERR_FILENO);
    close(this->Kept);
  }
  SilentStandardError(const SilentStandardError&) = delete;
  SilentStandardError& operator=(const SilentStandardError&) = delete;

private:
  int Kept;
};

struct OccupancySettings
{
  std::string maps;
  std::string output;
  double resolution = 0;
  UnionOptions freeSpace;
  GlobalShiftOption globalShift;
};

}

void AddOccupancyCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<OccupancySettings>();
  CLI::App* command =
    program.add_subcommand("occupancy", "Write free, occupied and unknown space as an OctoMap");
  command->add_option("maps", settings->maps, "The disparity maps")
    ->required()
    ->type_name("MAPS.vtm");
  command->add_option("-o,--output", settings->output, "The OctoMap to write (.bt or .ot)")
    ->required()
    ->type_name("MAP.bt");
  command
    ->add_option("--resolution", settings->resolution,
      "Side of the smallest cells in the scene's unit (0: 1/128 of the longest side)")
    ->check(NonNegative())
    ->capture_default_str();
  settings->freeSpace.AddTo(*command);
  settings->globalShift.AddTo(*command);
  command->footer("Example:\n  freespace occupancy maps.vtm -o map.bt --resolution 0.005");
  command->callback(session.Defer(
    [settings, &session]()
    {
      CheckOutputFolder(settings->output);
      const auto maps = ReadMaps(session, settings->maps);
      vtkNew<vtkOccupancyMapWriter> writer;
      writer->SetInputDataObject(maps);
      writer->SetFileName(settings->output);
      writer->SetResolution(settings->resolution);
      settings->freeSpace.SetUp(writer.Get());
      writer->SetAutomaticGlobalShift(settings->globalShift.IsAutomatic());
      writer->SetGlobalShift(settings->globalShift.For({}).data());
      session.Watch(writer, "occupancy",
        [&]
        {
          const SilentStandardError silent;
          writer->Write();
        });
      session.Log("wrote " + settings->output);
    }));
}

}
