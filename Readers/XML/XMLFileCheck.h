// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_XMLFileCheck_h
#define freespace_XMLFileCheck_h

#include <string>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// VTK's XML readers trust their files: deeply nested elements overflow the stack, too large an index or
/// count exhausts the memory, a truncated section is read beyond its end. Checks the header of a file
/// against its length before they read it, and returns the files that it names, in its order. Throws Error
/// naming the file.
std::vector<std::string> CheckXMLFile(const std::string& fileName);

/// The same for its content.
std::vector<std::string> CheckXMLContent(const std::string& content, const std::string& fileName);

/// Checks that the cells refer to existing points only. Throws Error naming the file.
void CheckCells(vtkPolyData* surface, const std::string& fileName);

}

#endif
