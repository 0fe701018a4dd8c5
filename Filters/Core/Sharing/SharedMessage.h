// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharedMessage_h
#define freespace_SharedMessage_h

#include "Sharing/SharedLoop.h"

#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// How the work of a process ended.
enum class Outcome : int
{
  Done = 0,
  Failed = 1,
  Stopped = 2 ///< on request
};

/// What the processes that share work tell each other. A process sends Request, and gets one answer, Items or LoopEnd,
/// before it sends the next one: the first process answers at once, but for one that has made all that it was given,
/// when there is nothing left, which is answered when all have. So there are never two that both wait until the
/// other receives a long message. When its work has ended, a process sends Ended, whatever was asked before, and
/// waits for Verdict; when the work of the first one has failed, it sends LoopEnd to all others, asked or not.
struct SharedMessage
{
  enum class Kind : int
  {
    Request, ///< `made` and how many `threads` have no item, in a loop with this number and count of items
    Items,   ///< the next `items` for the process
    LoopEnd, ///< what the others have `made`; or, Failed, the `sentence` of why all end
    Ended,   ///< `outcome`, `sentence` and notes of the process
    Verdict  ///< `outcome` and sentence of all
  };

  Kind kind = Kind::Request;
  std::size_t loop = 0;
  std::size_t count = 0;
  int threads = 0;
  bool areLast = false; ///< no items will follow
  std::vector<std::size_t> items;
  std::vector<MadeItem> made;
  Outcome outcome = Outcome::Done;
  std::string sentence;
  std::vector<std::string> notes;
};

template <typename Bytes>
void Exchange(Bytes& bytes, SharedMessage& message)
{
  bytes(message.kind, message.loop, message.count, message.threads, message.areLast, message.items,
    message.made, message.outcome, message.sentence, message.notes);
}

}

#endif
