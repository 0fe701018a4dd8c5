// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RunWriter_h
#define freespace_RunWriter_h

#include <functional>
#include <string>

class vtkWriter;

namespace freespace
{

/// Runs a writer's work, and returns the error code that lets its Write() return 1 or 0. An exception of the work
/// becomes the writer's error, whose code goes by what it is and the name of the file; an abort sets the code only.
unsigned long RunWriter(
  vtkWriter* writer, const std::string& fileName, const std::function<void()>& write);

}

#endif
