// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WholeFile_h
#define freespace_WholeFile_h

#include <string>

namespace freespace
{

/// Whether a file is whole by its format's own account. VTK's readers trust what a header announces:
/// of a file that was cut off they read part without a word, or crash.
/// Each throws Error naming the file when it is missing, cut off or not of its format.

/// VTK's XML formats end with a closing tag.
void CheckWholeVTKFile(const std::string& fileName);

/// A PLY header announces its elements: those must be there.
void CheckWholePLY(const std::string& fileName);

/// A binary STL announces its triangles, a text one ends with "endsolid".
void CheckWholeSTL(const std::string& fileName);

/// A JPEG ends with a marker; decoders make up what is missing before it. Other pictures pass.
void CheckWholeJPEG(const std::string& fileName);

}

#endif
