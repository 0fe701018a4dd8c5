// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceFiles_h
#define freespace_SurfaceFiles_h

#include "Options/GlobalShiftOption.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace freespace
{

class Session;

/// Reads a surface (.ply .stl .obj .vtp).
vtkSmartPointer<vtkPolyData> ReadSurface(Session& session, const std::string& fileName);

/// Writes a surface; the extension of the file determines the format.
void WriteSurface(Session& session, vtkPolyData* surface, const std::string& fileName,
  const GlobalShiftOption& globalShift = {});

/// Throws Error when a file's folder cannot be written: before hours of work, not after.
void CheckOutputFolder(const std::string& fileName);

/// The same; also if the extension is not that of a surface.
void CheckSurfaceName(const std::string& fileName);

}

#endif
