// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Session_h
#define freespace_Session_h

#include "Session/Choices.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkObject;
class vtkWriter;

namespace freespace
{

class Ranks;
class SharedWork;

/// The common part of all commands: the options --quiet, --threads and --strict, and running VTK algorithms so that
/// their progress is shown, their errors become one sentence and an interrupt stops them cleanly. Warnings
/// are reported when they arise and again at the end of the run; --strict turns the first one into an error,
/// before the command writes its output.
class Session
{
public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Adds the shared options to the program.
  void AddOptions(CLI::App& program);

  /// Which processes run a command if mpiexec started several.
  enum class Sharing
  {
    FirstProcess,
    AllProcesses ///< they share it out, see Ranks
  };

  /// The action of a command, to be run after the command line and the whole config file are read: CLI11
  /// calls back for a section of the config file before it has read the rest.
  std::function<void()> Defer(
    std::function<void()> action, Sharing sharing = Sharing::FirstProcess);

  /// Runs the action of the command.
  void RunCommand();

  /// While all processes run a command: what they share its work out by, or null where there is one alone.
  SharedWork* Shared() const;

  /// Whether this process writes the output: the only or the first one.
  bool IsWriter() const;

  /// The same, before anything is written: waits until all processes have come here, and reports the warnings of the
  /// others. Throws Error when one has failed.
  bool MayWrite();

  /// Updates the algorithm, or a piece of its output, under a stage's name. Throws Error with what the
  /// first error said.
  void Run(vtkAlgorithm* algorithm, const std::string& stage, int piece = 0, int pieces = 1);

  /// Runs some work of an algorithm, or of a vtkFreespaceUnion, under a stage's name: its progress is
  /// shown, and an interrupt sets its AbortExecute. Throws Error like Run.
  void Watch(vtkObject* worker, const std::string& stage, const std::function<void()>& work);

  /// Runs a writer. Throws Error like Run.
  void Write(vtkWriter* writer);

  /// Reports the warnings and throws Error with the first VTK error since the last stage began, if there was
  /// one.
  void ThrowIfFailed();

  /// A warning, a sentence. Throws Error with it when warnings are errors.
  void Warn(const std::string& sentence);

  /// A line of the log, not shown when quiet.
  void Log(const std::string& line) const;

  /// What was chosen automatically, and the option that chooses otherwise, if there is one: for the report.
  void NoteChoice(
    const std::string& what, const std::string& choice, const std::string& option = {});

  /// The same, with a line "what: choice" of the log.
  void LogChoice(
    const std::string& what, const std::string& choice, const std::string& option = {});

  /// The choices since the last call, and the warnings of the run, of which each says what was left out.
  Choices TakeChoices();

private:
  void Begin();
  void RunShared();
  void TellWarning(const std::string& sentence);
  void ThrowIfStrict() const;
  void SumUp() const;

  bool Quiet = false;
  bool Strict = false;
  std::vector<std::string> Warnings; // of the run, each once
  std::size_t WarningsTaken = 0;     // of these, by TakeChoices
  Choices Chosen;
  int Threads = 0;
  Sharing ActionSharing = Sharing::FirstProcess;
  std::unique_ptr<Ranks> Processes; // once all run the command
  std::function<void()> Action;
};

}

#endif
