// SPDX-License-Identifier: BSD-3-Clause
#include "Session/Session.h"

#include "Common/Error.h"
#include "Files/NameEncoding.h"
#include "Session/ErrorCollector.h"
#include "Session/Interrupts.h"
#include "Session/ProgressLine.h"
#include "Session/Ranks.h"
#include "Session/StderrCapture.h"
#include "Sharing/SharedWork.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkFreespaceUnion.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSMPTools.h>
#include <vtkWriter.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <utility>

namespace freespace
{

namespace
{

void OnProgress(vtkObject* caller, unsigned long, void* line, void* fraction)
{
  static_cast<ProgressLine*>(line)->Show(*static_cast<double*>(fraction));
  if (Interrupt() == 0)
  {
    return;
  }
  if (auto* algorithm = vtkAlgorithm::SafeDownCast(caller))
  {
    algorithm->SetAbortExecute(1);
  }
  else if (auto* phi = vtkFreespaceUnion::SafeDownCast(caller))
  {
    phi->SetAbortExecute(1);
  }
}

ErrorCollector* Collector()
{
  static vtkNew<ErrorCollector> collector;
  return collector;
}

// Runs some work with its progress shown, its errors collected and interrupts passed on. Returns what libraries
// printed meanwhile.
std::vector<std::string> DoWatched(
  vtkObject* worker, ProgressLine& line, const std::function<void()>& work)
{
  const StderrCapture words;
  Collector()->Clear();
  vtkNew<vtkCallbackCommand> onProgress;
  onProgress->SetCallback(OnProgress);
  onProgress->SetClientData(&line);
  const unsigned long tag = worker->AddObserver(vtkCommand::ProgressEvent, onProgress);
  work();
  worker->RemoveObserver(tag);
  return words.Lines();
}

}

Session::Session() = default;

Session::~Session() = default;

void Session::AddOptions(CLI::App& program)
{
  program.add_flag("-q,--quiet", this->Quiet, "Print only results and errors");
  program.add_flag("--strict", this->Strict,
    "Treat every warning as an error: the output that it concerns is not written");
  program.add_option("--threads", this->Threads, "Threads to use; 0: all cores")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
}

void Session::Begin()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(Collector());
  vtkSMPTools::Initialize(this->Threads);
}

std::function<void()> Session::Defer(std::function<void()> action, Sharing sharing)
{
  return [this, action, sharing]()
  {
    this->Action = action;
    this->ActionSharing = sharing;
  };
}

void Session::RunCommand()
{
  if (LaunchedRank() > 0 && this->ActionSharing == Sharing::FirstProcess)
  {
    return;
  }
  this->Quiet = this->Quiet || LaunchedRank() > 0;
  this->Begin();
  if (this->ActionSharing == Sharing::AllProcesses)
  {
    this->RunShared();
  }
  else
  {
    this->Action();
    this->ThrowIfFailed(); // by what was done beside the stages
  }
  this->SumUp();
}

void Session::RunShared()
{
  this->Processes = std::make_unique<Ranks>();
  const auto action = [this]
  {
    this->Action();
    this->ThrowIfFailed();
  };
  this->Shared() ? this->Shared()->Together(action) : action();
  if (this->Shared() && this->IsWriter())
  {
    std::ostringstream megabytes;
    megabytes.precision(3);
    megabytes << 1e-6 * static_cast<double>(this->Shared()->BytesExchanged());
    this->Log(
      std::to_string(this->Shared()->Count()) + " processes exchanged " + megabytes.str() + " MB");
  }
}

SharedWork* Session::Shared() const
{
  return this->Processes ? this->Processes->Work() : nullptr;
}

bool Session::MayWrite()
{
  if (this->Shared())
  {
    for (const std::string& warning : this->Shared()->Agree(this->Warnings))
    {
      this->TellWarning(warning);
    }
    this->ThrowIfStrict();
  }
  return this->IsWriter();
}

bool Session::IsWriter() const
{
  return !this->Shared() || this->Shared()->IsFirst();
}

void Session::Watch(vtkObject* worker, const std::string& stage, const std::function<void()>& work)
{
  ProgressLine line(stage, this->Quiet);
  const std::vector<std::string> words = DoWatched(worker, line, work);
  this->ThrowIfFailed(); // which tells better what libraries may have said, too
  line.Finish();
  const std::string place = stage + ": ";
  for (const std::string& word : words)
  {
    const bool isOurs = word.rfind("freespace: ", 0) == 0;
    isOurs ? this->Log(word) : this->TellWarning(place + word);
  }
  this->ThrowIfStrict();
}

void Session::Run(vtkAlgorithm* algorithm, const std::string& stage, int piece, int pieces)
{
  this->Watch(algorithm, stage,
    [&]
    {
      if (pieces > 1)
      {
        algorithm->UpdatePiece(piece, pieces, 0);
      }
      else
      {
        algorithm->Update();
      }
    });
}

void Session::Write(vtkWriter* writer)
{
  ProgressLine line("write", this->Quiet);
  bool written = false;
  DoWatched(writer, line, [&] { written = writer->Write() != 0; });
  this->ThrowIfFailed();
  if (!written)
  {
    throw Error("The output could not be written.");
  }
}

void Session::ThrowIfFailed()
{
  if (Interrupt() != 0)
  {
    throw Aborted();
  }
  for (const std::string& warning : Collector()->TakeWarnings())
  {
    this->TellWarning(warning);
  }
  const std::string error = Collector()->FirstError();
  if (!error.empty())
  {
    throw Error(error);
  }
  this->ThrowIfStrict();
}

void Session::Warn(const std::string& sentence)
{
  this->TellWarning(sentence);
  this->ThrowIfStrict();
}

void Session::TellWarning(const std::string& sentence)
{
  if (std::find(this->Warnings.begin(), this->Warnings.end(), sentence) == this->Warnings.end())
  {
    this->Warnings.push_back(sentence);
    this->Log("freespace: warning: " + sentence);
  }
}

void Session::ThrowIfStrict() const
{
  if (this->Strict && !this->Warnings.empty())
  {
    throw Error("A warning is an error (--strict): " + this->Warnings.front());
  }
}

void Session::SumUp() const
{
  if (this->Warnings.empty())
  {
    return;
  }
  const std::size_t count = this->Warnings.size();
  this->Log("freespace: " + std::to_string(count) + (count == 1 ? " warning:" : " warnings:"));
  for (const std::string& warning : this->Warnings)
  {
    this->Log("  " + warning);
  }
}

void Session::NoteChoice(
  const std::string& what, const std::string& choice, const std::string& option)
{
  this->Chosen.emplace_back(option.empty() ? what : what + " (" + option + ")", choice);
}

void Session::LogChoice(
  const std::string& what, const std::string& choice, const std::string& option)
{
  this->Log(what + ": " + choice);
  this->NoteChoice(what, choice, option);
}

Choices Session::TakeChoices()
{
  for (; this->WarningsTaken < this->Warnings.size(); ++this->WarningsTaken)
  {
    this->NoteChoice("warning", this->Warnings[this->WarningsTaken]);
  }
  return std::exchange(this->Chosen, {});
}

void Session::Log(const std::string& line) const
{
  if (!this->Quiet)
  {
    std::cerr << Printable(line) << std::endl;
  }
}

}
