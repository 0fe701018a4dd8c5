// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WholeFile_h
#define freespace_WholeFile_h

#include <string>

namespace freespace
{

/// Checks that a file is complete, i.e. not truncated. VTK's readers trust the header: of a truncated
/// file they silently read a part, or crash.
/// Each throws Error naming the file when it is missing, truncated or of another format.

/// VTK's XML formats end with a closing tag.
void CheckWholeVTKFile(const std::string& fileName);

/// A PLY header gives the number of elements.
void CheckWholePLY(const std::string& fileName);

/// A binary STL header gives the number of triangles, a text file ends with "endsolid".
void CheckWholeSTL(const std::string& fileName);

/// A JPEG file ends with a marker; decoders invent the pixels that are missing. Other formats pass.
void CheckWholeJPEG(const std::string& fileName);

}

#endif
