// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_XMLFileCheck_h
#define freespace_XMLFileCheck_h

#include <string>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// VTK's XML readers trust their files: nested elements fill the stack, an index or a count that is too
/// great takes all memory, a truncated section is read beyond its end. Checks what a file says of itself
/// against its length before they see it, and returns the files that it names, in its order. Throws Error
/// naming the file.
std::vector<std::string> CheckXMLFile(const std::string& fileName);

/// The same for its content.
std::vector<std::string> CheckXMLContent(const std::string& content, const std::string& fileName);

/// Checks that all cells are made of the points that there are. Throws Error naming the file.
void CheckCells(vtkPolyData* surface, const std::string& fileName);

}

#endif
