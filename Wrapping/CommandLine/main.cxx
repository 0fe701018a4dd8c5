// SPDX-License-Identifier: BSD-3-Clause
// The batch program: surfaces from calibrated images, without a display.
#include "Commands/Commands.h"
#include "Common/Error.h"
#include "Files/AtomicOutput.h"
#include "Files/NameEncoding.h"
#include "Help/Documentation.h"
#include "Help/HelpFormatter.h"
#include "Help/UnknownWord.h"
#include "Session/Interrupts.h"
#include "Session/Ranks.h"
#include "Session/Session.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace
{

constexpr int failed = 1;
constexpr int misused = 2;

// Every image has index lists and rasters of some megabytes. Left to itself, malloc gives each back to the
// system, which clears the pages anew for the next image: a tenth of the time of the stereo.
void KeepFreedMemory()
{
#ifdef __GLIBC__
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte); // the greatest that malloc takes
  mallopt(M_TRIM_THRESHOLD, 512 * mebibyte);
  mallopt(M_TOP_PAD, 64 * mebibyte);
#endif
}

// One line, even if names in it contain control characters.
void Complain(const std::string& sentence)
{
  std::cerr << "freespace: " << freespace::Printable(sentence) << "\n";
}

// The options of the command that was given, without those of the others and those not set.
std::string ConfigText(const CLI::App& program)
{
  std::istringstream all(program.config_to_str(true, false));
  std::string text;
  for (std::string line; std::getline(all, line);)
  {
    const std::size_t dot = line.substr(0, line.find('=')).find('.');
    const bool isSet = line.find("=\"\"") == std::string::npos;
    if ((dot == std::string::npos && isSet) || line[0] == '[')
    {
      text += line + "\n";
    }
  }
  return text;
}

void SaveConfig(const CLI::App& program, const std::string& fileName)
{
  freespace::AtomicOutput target(fileName);
  const std::string text = ConfigText(program);
  target.Write(text.data(), text.size());
  target.Commit();
}

void DescribeProgram(CLI::App& program)
{
  program.name("freespace");
  program.formatter(std::make_shared<freespace::HelpFormatter>());
  program.set_version_flag("--version", "freespace " FREESPACE_VERSION);
  program.set_config("--config", "", "Read options from a file that --save-config wrote")
    ->check(CLI::ExistingFile)
    ->check(CLI::Validator(
      [](std::string& file) {
        return std::filesystem::is_regular_file(file) ? std::string() : "'" + file + "' is no file";
      },
      ""))
    ->type_name("FILE.ini");
  program.require_subcommand(1);
  program.fallthrough();
  program.allow_config_extras(CLI::config_extras_mode::error);
  program.footer("Example:\n"
                 "  freespace reconstruct scene.json -o mesh.ply --picture mesh.png\n"
                 "'freespace COMMAND --help' describes the options of a command.");
}

void AddCommands(CLI::App& program, freespace::Session& session)
{
  freespace::AddReconstructCommand(program, session);
  freespace::AddSparseCommand(program, session);
  freespace::AddDepthCommand(program, session);
  freespace::AddCalibrateCommand(program, session);
  freespace::AddClustersCommand(program, session);
  freespace::AddRefineCommand(program, session);
  freespace::AddStereoCommand(program, session);
  freespace::AddTriangulateCommand(program, session);
  freespace::AddContourCommand(program, session);
  freespace::AddQueryCommand(program, session);
  freespace::AddRenderCommand(program, session);
  freespace::AddTextureCommand(program, session);
  freespace::AddOccupancyCommand(program, session);
  freespace::AddReportCommand(program, session);
  freespace::AddViewCommand(program, session);
  freespace::AddMeshCommand(program, session);
  freespace::AddCompareCommand(program, session);
  freespace::AddInfoCommand(program, session);
  freespace::AddExportCommand(program, session);
  freespace::AddRunCommand(program, session);
}

// A section of the config file runs the command that it is named after, unless the command line names
// one itself: then that one's section counts.
void LetConfigRunCommands(CLI::App& program, int argc, char* argv[])
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::vector<CLI::App*> commands = program.get_subcommands({});
  const auto isNamed = [&words](const CLI::App* command)
  { return std::find(words.begin(), words.end(), command->get_name()) != words.end(); };
  const bool anyNamed = std::any_of(commands.begin(), commands.end(), isNamed);
  for (CLI::App* command : commands)
  {
    command->configurable(!anyNamed || isNamed(command));
    command->allow_config_extras(CLI::config_extras_mode::error);
  }
}

// The fault of the file of options.
std::string ConfigFault(const std::string& config, const std::string& what)
{
  const std::string beforeItem = "INI was not able to parse ";
  const std::size_t at = what.find(beforeItem);
  std::string item = at == std::string::npos ? "" : what.substr(at + beforeItem.size());
  item = item.substr(0, item.find(".++")); // how CLI11 marks a section's beginning
  const bool isText =
    std::all_of(item.begin(), item.end(), [](unsigned char c) { return c > 31 && c < 127; });
  return item.empty() || !isText
    ? config + " is not a file of options that --save-config wrote."
    : config + " names an option or a command that there is not: '" + item + "'.";
}

// Whether the option that an error begins with stands on the command line, and not in the file of options.
bool IsGivenByHand(const std::string& what, const std::vector<std::string>& words)
{
  const std::string option = what.substr(0, what.find(':'));
  return std::any_of(words.begin(), words.end(),
    [&option](const std::string& word) { return word.substr(0, word.find('=')) == option; });
}

// The file of options; empty without one, also where that is no file.
std::string ConfigFile(const CLI::App& program)
{
  const CLI::Option* config = program.get_config_ptr();
  if (config->empty()) // of which CLI11 2.4 reads the first word, too
  {
    return "";
  }
  try
  {
    return config->as<std::string>();
  }
  catch (const CLI::ParseError&)
  {
    return "";
  }
}

// One sentence about the fault of the command line or of the file of options that it names.
std::string Fault(
  const CLI::App& program, const CLI::ParseError& error, const std::vector<std::string>& words)
{
  const std::string config = ConfigFile(program);
  std::string what = error.what();
  const std::string own = program.get_name() + ": "; // CLI11 says it, too
  what = what.rfind(own, 0) == 0 ? what.substr(own.size()) : what;
  if (dynamic_cast<const CLI::ConfigError*>(&error))
  {
    return ConfigFault(config, what);
  }
  const bool isOfValue = dynamic_cast<const CLI::ValidationError*>(&error) ||
    dynamic_cast<const CLI::ConversionError*>(&error);
  if (isOfValue && what.rfind("--", 0) == 0 && !config.empty() && !IsGivenByHand(what, words))
  {
    return config + ": " + what;
  }
  // CLI11 misses a needed option before it finds one that there is not.
  const bool mayBeUnknown = dynamic_cast<const CLI::ExtrasError*>(&error) ||
    dynamic_cast<const CLI::RequiredError*>(&error);
  const std::string command = freespace::UnknownCommand(program);
  const std::string option = mayBeUnknown ? freespace::UnknownOption(program) : "";
  if (!command.empty() || !option.empty())
  {
    return command.empty() ? option : command;
  }
  if (!program.get_subcommands().empty())
  {
    return what;
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) && !config.empty())
  {
    return config + " names no command, and neither does the command line.";
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error))
  {
    return "Which command? 'freespace --help' lists them.";
  }
  return what;
}

int Run(freespace::Session& session, int argc, char* argv[])
{
  CLI::App program("Surfaces from calibrated images by feature based stereo.");
  std::string configToSave;
  DescribeProgram(program);
  session.AddOptions(program);
  program.add_option("--save-config", configToSave, "Write all options of this run to a file")
    ->configurable(false)
    ->type_name("FILE.ini");
  AddCommands(program, session);
  LetConfigRunCommands(program, argc, argv);
  if (argc == 3 && argv[1] == std::string("--write-documentation")) // for the build
  {
    freespace::WriteDocumentation(program, FREESPACE_VERSION, argv[2]);
    return 0;
  }
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::Success& wish) // --help, --version
  {
    const std::string unknown = freespace::UnknownCommand(program);
    if (unknown.empty())
    {
      return program.exit(wish);
    }
    Complain(unknown);
    return misused;
  }
  catch (const CLI::ParseError& error)
  {
    Complain(Fault(program, error, { argv + 1, argv + argc }));
    return misused;
  }
  if (!configToSave.empty() && freespace::LaunchedRank() == 0)
  {
    SaveConfig(program, configToSave);
  }
  session.RunCommand();
  std::cout.flush();
  if (!std::cout && freespace::LaunchedRank() == 0)
  {
    throw freespace::Error(
      "Cannot write to the standard output: the disk is full or it is closed.");
  }
  return 0;
}

}

int main(int argc, char* argv[])
{
  KeepFreedMemory();
  freespace::ListenToInterrupts();
  // A write fails then, which can be told.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  // Of the processes that mpiexec started only the first one prints.
  if (freespace::LaunchedRank() > 0)
  {
    std::cout.rdbuf(nullptr);
    std::cerr.rdbuf(nullptr);
  }
  freespace::Session
    session; // to its end processes wait for each other: the error is told before any ends
  try
  {
    return Run(session, argc, argv);
  }
  catch (const freespace::Aborted& abort)
  {
    if (freespace::IsFirstToTellInterrupt())
    {
      Complain(abort.what());
    }
    return freespace::InterruptStatus();
  }
  catch (const std::exception& error)
  {
    Complain(error.what());
    return failed;
  }
}
