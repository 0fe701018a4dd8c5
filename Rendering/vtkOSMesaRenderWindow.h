// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOSMesaRenderWindow
 * @brief an off-screen render window without X server, GPU or environment variable
 *
 * Renders with Mesa's software rasterizer through libOSMesa, under a VTK that was built for X11, as
 * Debian's is. Programs do not name the class: if no X server answers, the object factory of the module
 * creates it for vtkRenderWindow::New, and an interactor without a window system for
 * vtkRenderWindowInteractor::New, in C++ (with vtk_module_autoinit) and in Python (after the import of
 * freespace.vtkFreespaceRendering, before or after vtkRenderingOpenGL2). It can also be created by name,
 * with an X server as well. The environment variable FREESPACE_WINDOW decides instead of the X server: `osmesa` for
 * this class, `display` for VTK's own; vtkSurfacePicture uses this class unless it is `display`. Each window has its
 * own context; several windows can be used in turn, and each from one thread at a time.
 *
 * From release 9.4 VTK chooses such a window by itself, and this class does not exist.
 *
 * If no context can be created, an error is reported and Render does nothing; see SupportsOpenGL.
 *
 * @sa vtkSurfacePicture
 */
#ifndef vtkOSMesaRenderWindow_h
#define vtkOSMesaRenderWindow_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkGenericOpenGLRenderWindow.h"

#include <memory> // for Internals

class VTKFREESPACERENDERING_EXPORT vtkOSMesaRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkOSMesaRenderWindow* New();
  vtkTypeMacro(vtkOSMesaRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkGenericOpenGLRenderWindow::SetSize;
  /**
   * A size beyond what libOSMesa can render to, 16384 x 16384 pixels, is an error; the window keeps the one
   * that it had.
   */
  void SetSize(int width, int height) override;

  /**
   * Creates the context, if there is none, and VTK's state for it. Render calls it.
   */
  void Initialize() override;

  /**
   * Releases VTK's resources in the context, then the context. The next Render creates a new one.
   */
  void Finalize() override;

  ///@{
  /**
   * The context in this thread, with a buffer of the window's size.
   */
  void MakeCurrent() override;
  bool IsCurrent() override;
  void ReleaseCurrent() override;
  ///@}

  ///@{
  /**
   * Makes the context current, and restores the previous one. An actor that two windows share releases its
   * resources in the context of the other in between. Calls can be nested.
   */
  void PushContext() override;
  void PopContext() override;
  ///@}

  ///@{
  /**
   * Where there is an X server, the context is released afterwards: libGLX refuses to make a context of its own current
   * in a thread that has another library's.
   */
  void Render() override;
  int GetZbufferData(int x1, int y1, int x2, int y2, float* z) override;
  using vtkGenericOpenGLRenderWindow::GetZbufferData;
  ///@}

  ///@{
  /**
   * Whether a context can be created (it is created); it is never a direct one.
   */
  int SupportsOpenGL() override;
  vtkTypeBool IsDirect() override;
  ///@}

  /**
   * The OSMesaContext.
   */
  void* GetGenericContext() override;

  /**
   * An interactor without a window system, driven by calls.
   */
  vtkRenderWindowInteractor* MakeRenderWindowInteractor() override;

  ///@{
  /**
   * VTK's state for a new context.
   */
  void OpenGLInit() override;
  void OpenGLInitContext() override;
  ///@}

protected:
  vtkOSMesaRenderWindow();
  ~vtkOSMesaRenderWindow() override;

  int ReadPixels(
    const vtkRecti& rect, int front, int glFormat, int glType, void* data, int right) override;

private:
  bool CanRender();
  void LeaveToX();

  vtkOSMesaRenderWindow(const vtkOSMesaRenderWindow&) = delete;
  void operator=(const vtkOSMesaRenderWindow&) = delete;

  struct InternalState;
  std::unique_ptr<InternalState> Internals;
};

#endif
