// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BinaryGLTF_h
#define freespace_BinaryGLTF_h

#include <string>

class vtkImageData;
class vtkPolyData;

namespace freespace
{

/// Writes triangles with texture coordinates and their texture as a .glb. Throws Error on failure.
void WriteBinaryGLTF(
  vtkPolyData* surface, vtkImageData* texture, bool zUp, const std::string& fileName);

}

#endif
