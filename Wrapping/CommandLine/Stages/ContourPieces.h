// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourPieces_h
#define freespace_ContourPieces_h

#include <vtkSmartPointer.h>

#include <vector>

class vtkBisectionContourFilter;
class vtkPolyData;

namespace freespace
{

class Session;

/// The pieces of a contour, made by the processes that share the work of the session: each makes the next one when it
/// has made one. All of them are in the first process, none in the others. Throws Error as Session::Run does.
std::vector<vtkSmartPointer<vtkPolyData>> MakePieces(
  Session& session, vtkBisectionContourFilter* contour);

}

#endif
