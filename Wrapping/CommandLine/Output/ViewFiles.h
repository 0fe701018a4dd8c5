// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewFiles_h
#define freespace_ViewFiles_h

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// Reads a .vtm of features or disparity maps.
vtkSmartPointer<vtkMultiBlockDataSet> ReadViews(Session& session, const std::string& fileName);

/// The same for what 'stereo' or 'sparse' wrote. Throws Error when they are triangulated already.
vtkSmartPointer<vtkMultiBlockDataSet> ReadFeatures(Session& session, const std::string& fileName);

/// The same for what 'triangulate' wrote. Throws Error when there are features but no triangles.
vtkSmartPointer<vtkMultiBlockDataSet> ReadMaps(Session& session, const std::string& fileName);

/// Throws Error unless views can be written under that name: before hours of work, not after.
void CheckViewsName(const std::string& fileName);

/// Writes them.
void WriteViews(Session& session, vtkMultiBlockDataSet* views, const std::string& fileName);

}

#endif
