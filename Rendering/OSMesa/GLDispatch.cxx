// SPDX-License-Identifier: BSD-3-Clause
#include "OSMesa/GLDispatch.h"

#include "OSMesa/OSMesaLibrary.h"

#include <dlfcn.h>

// libGLdispatch exports these for libGLX and libEGL; no package has the header.
extern "C"
{
  struct __GLdispatchTableRec;

  struct __GLdispatchThreadStateRec
  {
    int tag; // which library owns the thread's context: 0 is GLX, 1 is EGL
    void (*threadDestroyedCallback)(__GLdispatchThreadStateRec*);
    void* owned[6]; // the dispatcher's; one pointer in release 1.6, two words before 1.1
  };

  int __glDispatchGetABIVersion(void);
  void __glDispatchInit(void);
  int __glDispatchNewVendorID(void);
  __GLdispatchTableRec* __glDispatchCreateTable(
    void* (*getProcAddress)(const char* name, void* parameter), void* parameter);
  unsigned char __glDispatchMakeCurrent(__GLdispatchThreadStateRec* state,
    __GLdispatchTableRec* table, int vendor, const void* patchCallbacks);
  void __glDispatchLoseCurrent(void);
  __GLdispatchThreadStateRec* __glDispatchGetCurrentThreadState(void);
}

namespace freespace
{

namespace
{

constexpr int SupportedABI = 1;
constexpr int TagThatIsNotGLX = 1;

void* OSMesaFunction(const char* name, void*)
{
  return reinterpret_cast<void*>(LoadOSMesa().procAddress(name));
}

struct OSMesaVendor
{
  __GLdispatchTableRec* table = nullptr;
  int id = 0;
};

// One table serves all threads and contexts: libOSMesa finds the context itself. It lives as long
// as the process, as libGLdispatch does.
const OSMesaVendor& Vendor()
{
  static const OSMesaVendor vendor = []
  {
    OSMesaVendor made;
    if (__glDispatchGetABIVersion() == SupportedABI)
    {
      __glDispatchInit();
      made.id = __glDispatchNewVendorID();
      made.table = __glDispatchCreateTable(OSMesaFunction, nullptr);
    }
    return made;
  }();
  return vendor;
}

thread_local __GLdispatchThreadStateRec threadState = { TagThatIsNotGLX,
  [](__GLdispatchThreadStateRec*) {}, {} };

}

// Through libGLX, which counts the uses. The library is there where a window of VTK's for X is.
void LeaveGLX()
{
  void* library = dlopen("libGLX.so.0", RTLD_LAZY | RTLD_NOLOAD);
  if (!library)
  {
    return;
  }
  using CurrentDisplay = void* (*)();
  using MakeCurrent = int (*)(void* display, unsigned long drawable, void* context);
  const auto display = reinterpret_cast<CurrentDisplay>(dlsym(library, "glXGetCurrentDisplay"));
  const auto makeCurrent = reinterpret_cast<MakeCurrent>(dlsym(library, "glXMakeCurrent"));
  if (void* current = display && makeCurrent ? display() : nullptr)
  {
    makeCurrent(current, 0, nullptr);
  }
  dlclose(library);
}

bool DispatchesToOSMesa()
{
  return __glDispatchGetCurrentThreadState() == &threadState;
}

bool DispatchToOSMesa()
{
  if (DispatchesToOSMesa())
  {
    return true;
  }
  const OSMesaVendor& vendor = Vendor();
  if (!vendor.table)
  {
    return false;
  }
  if (__glDispatchGetCurrentThreadState())
  {
    __glDispatchLoseCurrent(); // an EGL context was current: it has to be made so again
  }
  return __glDispatchMakeCurrent(&threadState, vendor.table, vendor.id, nullptr) != 0;
}

void StopDispatch()
{
  if (DispatchesToOSMesa())
  {
    __glDispatchLoseCurrent();
  }
}

}
