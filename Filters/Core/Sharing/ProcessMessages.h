// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProcessMessages_h
#define freespace_ProcessMessages_h

#include <string>

namespace freespace
{

/// Messages between processes that run the same program, as MPI sends them. The messages from one process to another
/// arrive in their order.
class ProcessMessages
{
public:
  virtual ~ProcessMessages() = default;

  /// The number of this process, from 0, and how many there are.
  virtual int Rank() const = 0;
  virtual int Count() const = 0;

  /// May wait until the other process receives it.
  virtual void Send(int to, const std::string& message) = 0;

  /// The next message that has arrived, and who sent it. False, at once, where there is none.
  virtual bool Receive(int& from, std::string& message) = 0;
};

}

#endif
