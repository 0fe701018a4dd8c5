// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BatchRun_h
#define freespace_BatchRun_h

#include "Batch/BatchFile.h"
#include "Batch/StepProcess.h"
#include "Report/Page/StageRecord.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace freespace
{

class Session;

struct BatchOptions
{
  int jobs = 0;           ///< scenes at a time; 0: as many as there are cores
  double memoryLimit = 0; ///< of all processes together, MiB; 0: none
  bool fresh = false;     ///< whether what an earlier run did counts for nothing
};

/// The result of a scene.
struct SceneResult
{
  std::string name;
  std::size_t stepsDone = 0;
  std::size_t stepsBefore = 0; ///< of these, in an earlier run
  std::string fault;           ///< what the step that failed said; empty: none
  double seconds = 0;          ///< of all its steps
  double mebibytes = 0;        ///< of the step that had most memory
};

/// The steps of a batch over its scenes. Each step is a process of the program in the folder of the scene's results,
/// which has a log of each step and the record of what was done: a later run continues where an earlier
/// one was stopped or killed: with the first step that has not succeeded, whose words or scene.json changed,
/// whose output is missing, or whose predecessor was run again.
///
/// A step is started if the peak memory of the running steps and its own, as measured on other scenes, is within
/// the limit; a step that no scene has run yet runs alone.
class BatchRun
{
public:
  BatchRun(const BatchFile& batch, const std::vector<BatchScene>& scenes, const std::string& folder,
    const BatchOptions& options);

  /// Throws Error when another batch is at work in the folder or it cannot be written, Aborted on an interrupt. A
  /// step that fails ends its scene only.
  std::vector<SceneResult> Run(Session& session);

private:
  struct Running
  {
    std::size_t scene = 0;
    std::chrono::steady_clock::time_point begin;
  };

  std::string FolderOf(std::size_t scene) const;
  std::string LogOf(std::size_t scene, std::size_t step) const;
  std::string StageOf(std::size_t step) const;
  std::vector<std::string> WordsOf(std::size_t scene, std::size_t step) const;
  bool IsDone(std::size_t scene, std::size_t step) const;
  void SkipWhatIsDone(std::size_t scene);
  bool HasRoom(std::size_t step) const;
  void StartWhatFits(Session& session);
  void End(Session& session, const StepEnd& end);
  std::vector<int> Processes() const;
  int Jobs() const;

  const BatchFile Batch;
  const std::vector<BatchScene> Scenes;
  const std::string Folder;
  const BatchOptions Options;
  std::vector<StageRecord> Records;
  std::vector<SceneResult> Results;
  std::vector<double> Peaks;        ///< MiB by step; negative: no scene has done it
  std::vector<std::size_t> Waiting; ///< scenes between two of their steps
  std::map<int, Running> Active;    ///< by process
};

}

#endif
