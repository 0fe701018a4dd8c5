// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharedWork_h
#define freespace_SharedWork_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Sharing/ProcessMessages.h"
#include "Sharing/SharedLoop.h"
#include "Sharing/SharedMessage.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace freespace
{

class HandOut;

/// Work that several processes do together. All of them do the same with the same input and come to the same result;
/// the items of loops that take long are shared out: the first process gives the others, and its own threads, the next
/// item whenever they have made one, and everything that was made to all. Without loops to be shared out, nothing is
/// exchanged but whether the work has succeeded.
///
/// To be used by one thread, which exchanges all messages.
class SharedWork
{
public:
  /// Of several processes; the messages must outlive it.
  explicit SharedWork(ProcessMessages& messages);

  bool IsFirst() const { return this->Messages.Rank() == 0; }
  int Count() const { return this->Messages.Count(); }

  /// What this process has sent and received, in bytes: in the first one, all that was exchanged.
  std::uint64_t BytesExchanged() const { return this->Exchanged; }

  /// Runs work in every process. When it throws in any, this throws in all: Aborted if it did anywhere, else an Error
  /// with the sentence of the first process that failed. What others make in loops then ends soon.
  void Together(const std::function<void()>& work);

  /// Waits, within Together, until all processes have come here, so that nothing is written when one of them has
  /// failed. Returns the notes of the others, in their order, to the first process. Throws as Together does.
  std::vector<std::string> Agree(std::vector<std::string> notes);

  /// Makes all items of a loop; to be called within Together, in all processes alike. Throws Error with the sentence
  /// of the first item that failed, and Aborted.
  void Do(const SharedLoop& loop, const ParallelFor& threads, const Progress& progress);

private:
  struct Ending
  {
    Outcome outcome = Outcome::Done;
    std::string sentence;
    std::vector<std::string> notes;
    bool isKnown = false;
  };

  static Ending Attempt(const std::function<void()>& work);
  void Lead(const SharedLoop& loop, const ParallelFor& threads, const Progress& progress);
  void Follow(const SharedLoop& loop, const ParallelFor& threads, const Progress& progress);
  void Serve(const SharedLoop& loop, HandOut& items);
  bool AllWait() const;
  std::vector<std::string> Settle(const Ending& own);
  Ending Collect(const Ending& own);
  Ending Report(const Ending& own);
  void EndLoops(const std::string& sentence);
  void Send(int to, SharedMessage message);
  bool Receive(int& from, SharedMessage& message);

  ProcessMessages& Messages;
  std::uint64_t Exchanged = 0;
  std::size_t Loops = 0;
  bool HaveEnded = false; // with a failure, which all know
  // What the first process knows of the others.
  std::vector<Ending> Endings;
  std::vector<char> AreWaiting; // until a loop ends
};

}

#endif
