// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OpenGLFunctions_h
#define freespace_OpenGLFunctions_h

/// The functions of OpenGL as VTK loads them; the loader depends on the release.
#include <vtkVersionMacros.h>
#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 4)
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
