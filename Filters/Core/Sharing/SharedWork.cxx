// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/SharedWork.h"

#include "Common/Error.h"
#include "Sharing/Bytes.h"
#include "Sharing/HandOut.h"
#include "Sharing/LoopThreads.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace freespace
{

namespace
{

using Kind = SharedMessage::Kind;

constexpr char disagreement[] =
  "The processes do not do the same: they have different files or options.";

// Processes wait without taking a core from those that work.
void WaitShortly()
{
  std::this_thread::sleep_for(std::chrono::microseconds(250));
}

// Tells the progress, which is slower than messages are looked for.
class SlowProgress
{
public:
  explicit SlowProgress(const Progress& progress)
    : Told(progress)
  {
  }

  void operator()(double fraction)
  {
    if (this->Calls++ % 80 == 0)
    {
      this->Told(fraction);
    }
  }

private:
  const Progress& Told;
  int Calls = 0;
};

void Throw(Outcome outcome, const std::string& sentence)
{
  if (outcome == Outcome::Stopped)
  {
    throw Aborted();
  }
  if (outcome == Outcome::Failed)
  {
    throw Error(sentence);
  }
}

void Take(const SharedLoop& loop, const std::vector<MadeItem>& madeByOthers)
{
  for (const MadeItem& made : madeByOthers)
  {
    if (!made.hasFailed)
    {
      loop.take(made.item, made.bytes);
    }
  }
}

}

SharedWork::SharedWork(ProcessMessages& messages)
  : Messages(messages)
  , Endings(messages.Count())
  , AreWaiting(messages.Count(), 0)
{
}

void SharedWork::Together(const std::function<void()>& work)
{
  this->HaveEnded = false;
  const Ending own = Attempt(work);
  if (this->HaveEnded)
  {
    Throw(own.outcome, own.sentence);
  }
  this->Settle(own);
}

std::vector<std::string> SharedWork::Agree(std::vector<std::string> notes)
{
  return this->Settle({ Outcome::Done, "", std::move(notes), true });
}

// Tells the others how the own work has ended, and throws when that of any has failed.
std::vector<std::string> SharedWork::Settle(const Ending& own)
{
  const Ending all = this->IsFirst() ? this->Collect(own) : this->Report(own);
  this->HaveEnded = all.outcome != Outcome::Done;
  Throw(all.outcome, all.sentence);
  return all.notes;
}

SharedWork::Ending SharedWork::Attempt(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Aborted& abort)
  {
    return { Outcome::Stopped, abort.what(), {}, true };
  }
  catch (const std::exception& error)
  {
    return { Outcome::Failed, error.what(), {}, true };
  }
  return { Outcome::Done, "", {}, true };
}

// In the first process: waits until all have ended. Those in a loop do when they are told to.
SharedWork::Ending SharedWork::Collect(const Ending& own)
{
  this->Endings[0] = own;
  if (own.outcome != Outcome::Done)
  {
    this->EndLoops(own.sentence);
  }
  while (std::any_of(this->Endings.begin(), this->Endings.end(),
    [](const Ending& ending) { return !ending.isKnown; }))
  {
    int from = 0;
    SharedMessage message;
    if (!this->Receive(from, message))
    {
      WaitShortly();
    }
    else if (message.kind == Kind::Ended)
    {
      this->Endings[from] = { message.outcome, message.sentence, std::move(message.notes), true };
    }
    else if (this->Endings[0].outcome == Outcome::Done)
    {
      this->Endings[0] = { Outcome::Failed, disagreement, {}, true };
      this->EndLoops(disagreement);
    }
  }
  // Stopped is the greatest outcome, and the first of equal ones counts.
  Ending all = *std::max_element(this->Endings.begin(), this->Endings.end(),
    [](const Ending& a, const Ending& b) { return a.outcome < b.outcome; });
  for (int process = 1; process < this->Messages.Count(); ++process)
  {
    SharedMessage verdict;
    verdict.kind = Kind::Verdict;
    verdict.outcome = all.outcome;
    verdict.sentence = all.sentence;
    this->Send(process, std::move(verdict));
  }
  all.notes.clear();
  for (int process = 1; process < this->Messages.Count(); ++process)
  {
    const std::vector<std::string>& notes = this->Endings[process].notes;
    all.notes.insert(all.notes.end(), notes.begin(), notes.end());
  }
  std::fill(this->Endings.begin(), this->Endings.end(), Ending());
  return all;
}

// In another process.
SharedWork::Ending SharedWork::Report(const Ending& own)
{
  SharedMessage ended;
  ended.kind = Kind::Ended;
  ended.outcome = own.outcome;
  ended.sentence = own.sentence;
  ended.notes = own.notes;
  this->Send(0, std::move(ended));
  SharedMessage message;
  for (int from = 0; !this->Receive(from, message) || message.kind != Kind::Verdict;)
  {
    WaitShortly();
  }
  return { message.outcome, message.sentence, {}, true };
}

void SharedWork::Do(const SharedLoop& loop, const ParallelFor& threads, const Progress& progress)
{
  if (loop.work.empty())
  {
    return;
  }
  ++this->Loops;
  this->IsFirst() ? this->Lead(loop, threads, progress) : this->Follow(loop, threads, progress);
  progress(1.0);
}

void SharedWork::Lead(const SharedLoop& loop, const ParallelFor& threads, const Progress& progress)
{
  HandOut items(loop, this->Messages.Count());
  std::fill(this->AreWaiting.begin(), this->AreWaiting.end(), 0);
  {
    LoopThreads own(loop, threads);
    SlowProgress told(progress);
    while (items.HasItems() || !items.IsIdle(0) || !this->AllWait())
    {
      told(items.Fraction());
      items.Accept(0, own.TakeMade());
      own.Give(items.Give(0, own.Waiting()));
      this->Serve(loop, items);
      WaitShortly();
    }
  }
  if (const MadeItem* failed = items.Failed())
  {
    throw Error(failed->bytes); // the others are told in Collect
  }
  for (int process = 1; process < this->Messages.Count(); ++process)
  {
    SharedMessage end;
    end.kind = Kind::LoopEnd;
    if (!loop.isForFirst)
    {
      end.made = items.MadeByOthers(process);
    }
    this->Send(process, std::move(end));
  }
}

bool SharedWork::AllWait() const
{
  return std::count(this->AreWaiting.begin() + 1, this->AreWaiting.end(), 0) == 0;
}

// Answers what the others have asked.
void SharedWork::Serve(const SharedLoop& loop, HandOut& items)
{
  int from = 0;
  for (SharedMessage request; this->Receive(from, request);)
  {
    if (request.kind == Kind::Ended)
    {
      this->Endings[from] = { request.outcome, request.sentence, {}, true };
      throw Error(request.outcome == Outcome::Done ? disagreement : request.sentence);
    }
    if (request.loop != this->Loops || request.count != loop.work.size())
    {
      throw Error(disagreement);
    }
    Take(loop, request.made);
    items.Accept(from, std::move(request.made));
    if (!items.HasItems() && items.IsIdle(from))
    {
      this->AreWaiting[from] = 1;
      continue;
    }
    SharedMessage answer;
    answer.kind = Kind::Items;
    answer.items = items.Give(from, request.threads);
    answer.areLast = !items.HasItems();
    this->Send(from, std::move(answer));
  }
}

void SharedWork::Follow(
  const SharedLoop& loop, const ParallelFor& threads, const Progress& progress)
{
  LoopThreads own(loop, threads);
  SlowProgress told(progress);
  SharedMessage answer;
  for (bool hasAsked = false; answer.kind != Kind::LoopEnd;)
  {
    told(0.0);
    int from = 0;
    if (this->Receive(from, answer))
    {
      own.Give(answer.items);
      hasAsked = false;
    }
    if (!hasAsked && answer.kind != Kind::LoopEnd)
    {
      SharedMessage request;
      request.loop = this->Loops;
      request.count = loop.work.size();
      request.made = own.TakeMade();
      request.threads = answer.areLast ? 0 : own.Waiting();
      if (!request.made.empty() || request.threads > 0)
      {
        this->Send(0, std::move(request));
        hasAsked = true;
      }
    }
    WaitShortly();
  }
  if (answer.outcome != Outcome::Done)
  {
    throw Error(answer.sentence);
  }
  Take(loop, answer.made);
}

// Tells all that have not ended to end, whether they wait for it or not.
void SharedWork::EndLoops(const std::string& sentence)
{
  for (int process = 1; process < this->Messages.Count(); ++process)
  {
    if (!this->Endings[process].isKnown)
    {
      SharedMessage end;
      end.kind = Kind::LoopEnd;
      end.outcome = Outcome::Failed;
      end.sentence = sentence;
      this->Send(process, std::move(end));
    }
  }
}

void SharedWork::Send(int to, SharedMessage message)
{
  const std::string bytes = BytesOf(message);
  this->Exchanged += bytes.size();
  this->Messages.Send(to, bytes);
}

bool SharedWork::Receive(int& from, SharedMessage& message)
{
  std::string bytes;
  if (!this->Messages.Receive(from, bytes))
  {
    return false;
  }
  this->Exchanged += bytes.size();
  message = FromBytes<SharedMessage>(bytes);
  return true;
}

}
