// SPDX-License-Identifier: BSD-3-Clause
#include "Batch/BatchRun.h"

#include "Common/Error.h"
#include "Files/FileLock.h"
#include "Files/PathChecks.h"
#include "Session/Session.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

/// Locks a folder against other runs; creates it if it does not exist.
FileLock LockFolder(const std::string& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string file = folder + "/.lock";
  if (!std::ofstream(file, std::ios::app))
  {
    throw Error("Cannot write into '" + folder + "'.");
  }
  FileLock lock = FileLock::Try(file);
  if (!lock.IsHeld())
  {
    throw Error("Another 'freespace run' is at work in '" + folder + "'.");
  }
  return lock;
}

std::string LastLine(const std::string& fileName)
{
  std::ifstream file(fileName);
  std::string last;
  for (std::string line; std::getline(file, line);)
  {
    last = line.empty() ? last : line;
  }
  const std::string program = "freespace: ";
  return last.rfind(program, 0) == 0 ? last.substr(program.size()) : last;
}

/// The output files of a step, as known from its options.
std::vector<std::string> OutputsOf(const std::vector<std::string>& words)
{
  std::vector<std::string> outputs;
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
  {
    if (words[i] == "-o" || words[i] == "--output")
    {
      outputs.push_back(words[i + 1]);
    }
  }
  return outputs;
}

}

BatchRun::BatchRun(const BatchFile& batch, const std::vector<BatchScene>& scenes,
  const std::string& folder, const BatchOptions& options)
  : Batch(batch)
  , Scenes(scenes)
  , Folder(folder)
  , Options(options)
  , Peaks(batch.steps.size(), -1)
{
}

std::string BatchRun::FolderOf(std::size_t scene) const
{
  return (fs::path(this->Folder) / this->Scenes[scene].name).string();
}

std::string BatchRun::StageOf(std::size_t step) const
{
  char number[8];
  std::snprintf(number, sizeof number, "%02u-", static_cast<unsigned>(step + 1) % 10000);
  return number + this->Batch.steps[step].front();
}

std::string BatchRun::LogOf(std::size_t scene, std::size_t step) const
{
  return (fs::path(this->FolderOf(scene)) / (this->StageOf(step) + ".log")).string();
}

// With the version of the program, which a step depends on, too.
std::vector<std::string> BatchRun::WordsOf(std::size_t scene, std::size_t step) const
{
  std::vector<std::string> words = WordsFor(this->Batch.steps[step], this->Scenes[scene]);
  words.push_back(FREESPACE_VERSION);
  return words;
}

bool BatchRun::IsDone(std::size_t scene, std::size_t step) const
{
  const std::vector<std::string> words = this->WordsOf(scene, step);
  for (const std::string& output : OutputsOf(words))
  {
    if (!IsThere(fs::path(this->FolderOf(scene)) / output))
    {
      return false;
    }
  }
  std::vector<std::string> inputs;
  if (IsFile(this->Scenes[scene].path))
  {
    inputs.push_back(this->Scenes[scene].path);
  }
  if (step > 0)
  {
    inputs.push_back(this->LogOf(scene, step - 1));
  }
  return this->Records[scene].IsCurrent(
    this->StageOf(step), words, this->LogOf(scene, step), inputs);
}

void BatchRun::SkipWhatIsDone(std::size_t scene)
{
  SceneResult& result = this->Results[scene];
  while (result.stepsDone < this->Batch.steps.size() && this->IsDone(scene, result.stepsDone))
  {
    const std::string stage = this->StageOf(result.stepsDone);
    const double mebibytes = this->Records[scene].Mebibytes(stage);
    result.seconds += this->Records[scene].Seconds(stage);
    result.mebibytes = std::max(result.mebibytes, mebibytes);
    this->Peaks[result.stepsDone] = std::max(this->Peaks[result.stepsDone], mebibytes);
    ++result.stepsBefore;
    ++result.stepsDone;
  }
}

int BatchRun::Jobs() const
{
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(
    this->Options.jobs > 0 ? this->Options.jobs : cores, static_cast<int>(this->Scenes.size()));
}

bool BatchRun::HasRoom(std::size_t step) const
{
  if (this->Active.empty() || this->Options.memoryLimit <= 0)
  {
    return true;
  }
  double needed = this->Peaks[step];
  bool areKnown = needed >= 0;
  for (const auto& [process, running] : this->Active)
  {
    const double peak = this->Peaks[this->Results[running.scene].stepsDone];
    areKnown = areKnown && peak >= 0;
    needed += peak;
  }
  return areKnown && needed <= this->Options.memoryLimit;
}

// Scenes that have begun come first, so that they are finished.
void BatchRun::StartWhatFits(Session& session)
{
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  while (static_cast<int>(this->Active.size()) < this->Jobs())
  {
    const auto fits = std::find_if(this->Waiting.begin(), this->Waiting.end(),
      [this](std::size_t scene) { return this->HasRoom(this->Results[scene].stepsDone); });
    if (fits == this->Waiting.end())
    {
      return;
    }
    const std::size_t scene = *fits, step = this->Results[scene].stepsDone;
    this->Waiting.erase(fits);
    std::vector<std::string> words = WordsFor(this->Batch.steps[step], this->Scenes[scene]);
    session.Log(this->Scenes[scene].name + ": " + words.front());
    if (std::find(words.begin(), words.end(), "--threads") == words.end())
    {
      const int threads = std::max(1, cores / this->Jobs());
      words.insert(words.begin(), { "--threads", std::to_string(threads) });
    }
    const int process = StartProgram(words, this->FolderOf(scene), this->LogOf(scene, step));
    this->Active[process] = { scene, std::chrono::steady_clock::now() };
  }
}

void BatchRun::End(Session& session, const StepEnd& end)
{
  const Running running = this->Active.at(end.process);
  this->Active.erase(end.process);
  SceneResult& result = this->Results[running.scene];
  const std::size_t step = result.stepsDone;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - running.begin;
  result.seconds += seconds.count();
  result.mebibytes = std::max(result.mebibytes, end.mebibytes);
  this->Peaks[step] = std::max(this->Peaks[step], end.mebibytes);
  if (end.status != 0)
  {
    const std::string last = LastLine(this->LogOf(running.scene, step));
    result.fault = this->StageOf(step) + ": " +
      (last.empty() ? "it ended with status " + std::to_string(end.status) + "." : last);
    session.Log(result.name + ": " + result.fault);
    return;
  }
  this->Records[running.scene].Set(
    this->StageOf(step), this->WordsOf(running.scene, step), seconds.count(), end.mebibytes);
  ++result.stepsDone;
  if (result.stepsDone < this->Batch.steps.size())
  {
    this->Waiting.insert(this->Waiting.begin(), running.scene);
  }
}

std::vector<int> BatchRun::Processes() const
{
  std::vector<int> processes;
  for (const auto& [process, running] : this->Active)
  {
    processes.push_back(process);
  }
  return processes;
}

std::vector<SceneResult> BatchRun::Run(Session& session)
{
  const FileLock lock = LockFolder(this->Folder);
  for (std::size_t scene = 0; scene < this->Scenes.size(); ++scene)
  {
    fs::create_directories(this->FolderOf(scene));
    const std::string record = this->FolderOf(scene) + "/steps.json";
    if (this->Options.fresh)
    {
      fs::remove(record);
    }
    this->Records.emplace_back(record);
    this->Results.emplace_back();
    this->Results.back().name = this->Scenes[scene].name;
    this->SkipWhatIsDone(scene);
    if (this->Results.back().stepsDone < this->Batch.steps.size())
    {
      this->Waiting.push_back(scene);
    }
  }
  try
  {
    for (this->StartWhatFits(session); !this->Active.empty(); this->StartWhatFits(session))
    {
      session.ThrowIfFailed(); // on an interrupt
      StepEnd end;
      if (HasEnded(this->Processes(), end))
      {
        this->End(session, end);
      }
      else
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }
  }
  catch (...)
  {
    StopAll(this->Processes());
    throw;
  }
  return this->Results;
}

}
