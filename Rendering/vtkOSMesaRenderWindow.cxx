// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOSMesaRenderWindow.h"

#include "OSMesa/GLDispatch.h"
#include "OSMesa/OSMesaLibrary.h"

#include <vtkGenericRenderWindowInteractor.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <unistd.h>

vtkStandardNewMacro(vtkOSMesaRenderWindow);

namespace
{

constexpr int LargestSide = 16384; // what llvmpipe has

// What was current in a thread.
struct CurrentContext
{
  OSMesaContext context = nullptr;
  void* pixels = nullptr;
  GLint width = 0;
  GLint height = 0;
};

CurrentContext GetCurrentContext()
{
  CurrentContext current;
  if (!freespace::DispatchesToOSMesa())
  {
    return current; // with a GLX context of Mesa's, OSMesa would take that for one of its own
  }
  current.context = freespace::LoadOSMesa().currentContext();
  GLint format = 0;
  if (current.context &&
    !freespace::LoadOSMesa().colorBuffer(
      current.context, &current.width, &current.height, &format, &current.pixels))
  {
    current.context = nullptr;
  }
  return current;
}

}

struct vtkOSMesaRenderWindow::InternalState
{
  std::vector<CurrentContext> pushed; // what PopContext makes current again
  OSMesaContext context = nullptr;
  std::vector<unsigned char> pixels; // the default framebuffer
  int width = 0;                     // of pixels
  int height = 0;
  bool failed = false; // reported once
};

namespace
{

// Mesa's threads are those of the process that made the first context: a copy of it that fork made waits for
// them without end.
bool IsForked()
{
  static const pid_t first = getpid();
  return getpid() != first;
}

// VTK asks for 3.2 at least; Mesa gives the newest core context that it has.
OSMesaContext CreateContext()
{
  const int attributes[] = { OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_STENCIL_BITS,
    8, OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION, 3,
    OSMESA_CONTEXT_MINOR_VERSION, 2, 0 };
  return freespace::LoadOSMesa().createContext(attributes, nullptr);
}

}

vtkOSMesaRenderWindow::vtkOSMesaRenderWindow()
  : Internals(new InternalState)
{
  this->Mapped = 1;
  this->SetOffScreenRendering(1);
  this->SetFrameBlitModeToNoBlit(); // pixels are read from VTK's own framebuffers
  this->SetScreenSize(LargestSide, LargestSide);
  this->Size[0] = this->Size[1] = 300; // as VTK's other windows
}

vtkOSMesaRenderWindow::~vtkOSMesaRenderWindow()
{
  this->Finalize();
  this->ReadyForRendering = false; // for the superclass, which finalizes again
}

void vtkOSMesaRenderWindow::SetSize(int width, int height)
{
  if (std::max(width, height) > LargestSide)
  {
    vtkErrorMacro("A window of " << width << "x" << height << " pixels cannot be rendered to: "
                                 << LargestSide << "x" << LargestSide << " is the largest.");
    return;
  }
  this->Superclass::SetSize(width, height);
}

void vtkOSMesaRenderWindow::Initialize()
{
  if (!this->Initialized)
  {
    this->OpenGLInit();
  }
}

void vtkOSMesaRenderWindow::Finalize()
{
  InternalState& state = *this->Internals;
  if (!state.context || IsForked())
  {
    return;
  }
  this->MakeCurrent();
  if (this->Initialized)
  {
    this->Superclass::Finalize();
  }
  this->ReleaseCurrent();
  freespace::LoadOSMesa().destroyContext(state.context);
  state = InternalState();
  this->Initialized = false;
  this->GlewInitValid = false;
}

void vtkOSMesaRenderWindow::MakeCurrent()
{
  InternalState& state = *this->Internals;
  if (IsForked())
  {
    if (!state.failed)
    {
      state.failed = true;
      vtkErrorMacro(
        "This process was forked from one that made pictures, in which Mesa cannot go on: "
        "start it afresh (multiprocessing's spawn).");
    }
    return;
  }
  if (!state.context && !state.failed)
  {
    const bool isLoaded = freespace::LoadOSMesa().IsLoaded();
    state.context = isLoaded ? CreateContext() : nullptr;
    state.failed = !state.context;
    if (state.failed)
    {
      vtkErrorMacro(<< (isLoaded
                        ? "libOSMesa gave no OpenGL 3.2 context."
                        : "Pictures need libOSMesa, which is not installed or not whole."));
    }
  }
  const int width = std::max(this->Size[0], 1);
  const int height = std::max(this->Size[1], 1);
  const bool fits = width == state.width && height == state.height;
  if (!state.context || (fits && this->IsCurrent()))
  {
    return;
  }
  if (!fits)
  {
    state.pixels.resize(std::size_t(4) * width * height);
    state.width = width;
    state.height = height;
  }
  if (!this->IsCurrent())
  {
    freespace::LeaveGLX();
  }
  if (!freespace::LoadOSMesa().makeCurrent(
        state.context, state.pixels.data(), GL_UNSIGNED_BYTE, width, height))
  {
    vtkErrorMacro("libOSMesa cannot render to " << width << "x" << height << " pixels.");
  }
  else if (!freespace::DispatchToOSMesa())
  {
    vtkErrorMacro("This machine's libGLdispatch is of an unknown binary interface.");
    this->ReleaseCurrent();
  }
}

bool vtkOSMesaRenderWindow::IsCurrent()
{
  return this->Internals->context &&
    freespace::LoadOSMesa().currentContext() == this->Internals->context &&
    freespace::DispatchesToOSMesa();
}

void vtkOSMesaRenderWindow::ReleaseCurrent()
{
  if (this->Internals->context &&
    freespace::LoadOSMesa().currentContext() == this->Internals->context)
  {
    freespace::LoadOSMesa().makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    freespace::StopDispatch();
  }
}

// What VTK does for a window of X between two calls of ours, makes its context current first, and fails while another
// library's is.
void vtkOSMesaRenderWindow::LeaveToX()
{
  const char* display = std::getenv("DISPLAY");
  if (display && *display)
  {
    this->ReleaseCurrent();
  }
}

// Without a context there are no functions of OpenGL to call; why there is none has been said.
bool vtkOSMesaRenderWindow::CanRender()
{
  this->Initialize();
  return this->Initialized != 0;
}

void vtkOSMesaRenderWindow::Render()
{
  if (!this->CanRender())
  {
    return;
  }
  this->Superclass::Render();
  this->LeaveToX();
}

int vtkOSMesaRenderWindow::ReadPixels(
  const vtkRecti& rect, int front, int glFormat, int glType, void* data, int right)
{
  if (!this->CanRender())
  {
    return VTK_ERROR;
  }
  const int result = this->Superclass::ReadPixels(rect, front, glFormat, glType, data, right);
  this->LeaveToX();
  return result;
}

int vtkOSMesaRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, float* z)
{
  if (!this->CanRender())
  {
    return VTK_ERROR;
  }
  const int result = this->Superclass::GetZbufferData(x1, y1, x2, y2, z);
  this->LeaveToX();
  return result;
}

void vtkOSMesaRenderWindow::PushContext()
{
  this->Internals->pushed.push_back(GetCurrentContext());
  this->MakeCurrent();
}

void vtkOSMesaRenderWindow::PopContext()
{
  InternalState& state = *this->Internals;
  if (state.pushed.empty())
  {
    return;
  }
  const CurrentContext previous = state.pushed.back();
  state.pushed.pop_back();
  if (previous.context == state.context && this->IsCurrent())
  {
    return;
  }
  if (!previous.context)
  {
    this->ReleaseCurrent();
    return;
  }
  freespace::LoadOSMesa().makeCurrent(
    previous.context, previous.pixels, GL_UNSIGNED_BYTE, previous.width, previous.height);
  freespace::DispatchToOSMesa();
}

int vtkOSMesaRenderWindow::SupportsOpenGL()
{
  const bool canRender = this->CanRender();
  this->LeaveToX();
  return canRender ? 1 : 0;
}

vtkTypeBool vtkOSMesaRenderWindow::IsDirect()
{
  return 0;
}

void* vtkOSMesaRenderWindow::GetGenericContext()
{
  return this->Internals->context;
}

vtkRenderWindowInteractor* vtkOSMesaRenderWindow::MakeRenderWindowInteractor()
{
  this->Interactor = vtkGenericRenderWindowInteractor::New();
  this->Interactor->SetRenderWindow(this);
  return this->Interactor;
}

void vtkOSMesaRenderWindow::OpenGLInit()
{
  // The superclass calls OpenGL before it makes the context current.
  this->MakeCurrent();
  this->OpenGLInitContext();
  if (this->Initialized)
  {
    this->Superclass::OpenGLInit();
  }
}

void vtkOSMesaRenderWindow::OpenGLInitContext()
{
  this->ContextCreationTime.Modified();
  if (this->Initialized || !this->IsCurrent())
  {
    return;
  }
  // glew has loaded all functions of OpenGL when it goes on to GLX and misses the X server.
  const GLenum result = glewInit();
#ifdef GLEW_ERROR_NO_GLX_DISPLAY
  this->GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
#else
  this->GlewInitValid = result == GLEW_OK;
#endif
  if (!this->GlewInitValid || !GLEW_VERSION_3_2)
  {
    vtkErrorMacro("OpenGL 3.2 could not be loaded from libOSMesa: "
      << reinterpret_cast<const char*>(glewGetErrorString(result)));
    return;
  }
  this->Initialized = true;
}

void vtkOSMesaRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Context: " << this->Internals->context << "\n";
  os << indent << "Buffer: " << this->Internals->width << "x" << this->Internals->height << "\n";
}
