// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Picture_h
#define freespace_Picture_h

#include <string>

class vtkPolyData;

namespace freespace
{

class Session;

/// Throws Error unless a picture can be written under that name.
void CheckPictureName(const std::string& fileName);

/// Writes a picture of a surface as PNG, from the camera of a view's block or, where that is nullptr,
/// obliquely from above. Throws Error when that fails.
void WritePicture(
  Session& session, vtkPolyData* surface, vtkPolyData* view, const std::string& fileName);

}

#endif
