// SPDX-License-Identifier: BSD-3-Clause
#include "OSMesa/OSMesaLibrary.h"

#include <dlfcn.h>

namespace freespace
{

namespace
{

template <typename Function>
bool FindFunction(void* library, const char* name, Function& function)
{
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

OSMesaLibrary Load()
{
  void* library = dlopen(FREESPACE_OSMESA_SONAME, RTLD_LAZY | RTLD_LOCAL);
  OSMesaLibrary loaded;
  const bool isWhole = library &&
    FindFunction(library, "OSMesaCreateContextAttribs", loaded.createContext) &&
    FindFunction(library, "OSMesaDestroyContext", loaded.destroyContext) &&
    FindFunction(library, "OSMesaMakeCurrent", loaded.makeCurrent) &&
    FindFunction(library, "OSMesaGetCurrentContext", loaded.currentContext) &&
    FindFunction(library, "OSMesaGetColorBuffer", loaded.colorBuffer) &&
    FindFunction(library, "OSMesaGetProcAddress", loaded.procAddress);
  return isWhole ? loaded : OSMesaLibrary();
}

}

const OSMesaLibrary& LoadOSMesa()
{
  static const OSMesaLibrary library = Load(); // until the process ends, as its threads
  return library;
}

}
