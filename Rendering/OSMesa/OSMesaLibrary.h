// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OSMesaLibrary_h
#define freespace_OSMesaLibrary_h

#include "vtk_glew.h"
// glew takes away the macro that osmesa.h needs.
#ifndef GLAPI
#define GLAPI extern
#endif
#ifndef APIENTRY
#define APIENTRY GLAPIENTRY
#endif
#include <GL/osmesa.h>

namespace freespace
{

/// The functions of libOSMesa.
///
/// The library brings LLVM with it, which takes longer to load than all else together: that is done when the first
/// context is made, so that only those pay for it who render.
struct OSMesaLibrary
{
  decltype(&OSMesaCreateContextAttribs) createContext = nullptr;
  decltype(&OSMesaDestroyContext) destroyContext = nullptr;
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetCurrentContext) currentContext = nullptr;
  decltype(&OSMesaGetColorBuffer) colorBuffer = nullptr;
  decltype(&OSMesaGetProcAddress) procAddress = nullptr;

  bool IsLoaded() const { return this->procAddress != nullptr; }
};

/// Loads the library at the first call. Thread-safe.
const OSMesaLibrary& LoadOSMesa();

}

#endif
