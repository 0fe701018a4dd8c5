// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BinaryGLTF_h
#define freespace_BinaryGLTF_h

class vtkImageData;
class vtkPolyData;

namespace freespace
{

class AtomicOutput;

/// Writes triangles with texture coordinates and their texture as a .glb.
/// Throws Error on failure.
void WriteBinaryGLTF(
  vtkPolyData* surface, vtkImageData* texture, bool zUp, const AtomicOutput& target);

}

#endif
