// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RunWriter_h
#define freespace_RunWriter_h

#include <functional>

class vtkWriter;

namespace freespace
{

/// Does a writer's work, and returns the error code that lets its Write() return 1 or 0. What the work throws
/// becomes the writer's error; being asked to stop is told by the code alone.
unsigned long RunWriter(vtkWriter* writer, const std::function<void()>& write);

}

#endif
