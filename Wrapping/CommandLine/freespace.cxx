// SPDX-License-Identifier: BSD-3-Clause
// The batch program: surfaces from calibrated photographs, without a display.
#include "Commands.h"
#include "Error.h"
#include "Session.h"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{

constexpr int failed = 1;
constexpr int misused = 2;
constexpr int stopped = 130;

void SaveConfig(const CLI::App& program, const std::string& fileName)
{
  const std::string unfinished = fileName + ".unfinished";
  std::ofstream file(unfinished);
  file << program.config_to_str(true, false);
  file.close();
  std::error_code renaming;
  if (file)
  {
    std::filesystem::rename(unfinished, fileName, renaming);
  }
  if (!file || renaming)
  {
    throw freespace::Error("Cannot write " + fileName + ": its folder is missing or not writable.");
  }
}

void DescribeProgram(CLI::App& program)
{
  program.name("freespace");
  program.set_version_flag("--version", "freespace " FREESPACE_VERSION);
  program.set_config("--config", "", "Read options from a file that --save-config wrote")
    ->check(CLI::ExistingFile);
  program.require_subcommand(1);
  program.fallthrough();
  program.footer("Example:\n"
                 "  freespace reconstruct scene.json -o mesh.ply --picture mesh.png\n"
                 "'freespace COMMAND --help' tells the options of a command.");
}

int Run(int argc, char* argv[])
{
  CLI::App program("Surfaces from calibrated photographs by feature based stereo.");
  freespace::Session session;
  std::string configToSave;
  DescribeProgram(program);
  session.AddOptions(program);
  program.add_option("--save-config", configToSave, "Write all options of this run to a file")
    ->configurable(false);
  program.parse_complete_callback(
    [&]()
    {
      session.Begin();
      if (!configToSave.empty())
      {
        SaveConfig(program, configToSave);
      }
    });
  freespace::AddReconstructCommand(program, session);
  freespace::AddSparseCommand(program, session);
  freespace::AddCalibrateCommand(program, session);
  freespace::AddClustersCommand(program, session);
  freespace::AddStereoCommand(program, session);
  freespace::AddTriangulateCommand(program, session);
  freespace::AddContourCommand(program, session);
  freespace::AddQueryCommand(program, session);
  freespace::AddRenderCommand(program, session);
  freespace::AddTextureCommand(program, session);
  freespace::AddOccupancyCommand(program, session);
  freespace::AddViewCommand(program, session);
  for (CLI::App* command : program.get_subcommands({}))
  {
    command->configurable(); // a section of the config file runs the command
  }
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::Success& wish) // --help, --version
  {
    return program.exit(wish);
  }
  catch (const CLI::ParseError& error)
  {
    std::cerr << "freespace: " << error.what() << "\n";
    return misused;
  }
  return 0;
}

}

int main(int argc, char* argv[])
{
  try
  {
    return Run(argc, argv);
  }
  catch (const freespace::Aborted& abort)
  {
    std::cerr << "freespace: " << abort.what() << "\n";
    return stopped;
  }
  catch (const std::exception& error)
  {
    std::cerr << "freespace: " << error.what() << "\n";
    return failed;
  }
}
