// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Error_h
#define freespace_Error_h

#include <stdexcept>

namespace freespace
{

/// Thrown by the core on invalid input: one sentence that names the file and the fault.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Thrown by Progress when the user asked to stop.
class Aborted : public Error
{
public:
  Aborted()
    : Error("Stopped on request.")
  {
  }
};

}

#endif
