// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOSMesaRenderWindow
 * @brief a render window in memory: no X server, no GPU, no environment variable
 *
 * It renders with Mesa's software rasterizer through libOSMesa, below a VTK that was built for X11
 * as Debian's is. Nobody needs to name the class: where no X server answers, the module's object
 * factory makes it whenever a vtkRenderWindow is asked for, in C++ (with vtk_module_autoinit) and
 * in Python (once freespace.vtkFreespaceRendering is imported, before or after
 * vtkRenderingOpenGL2), and an interactor without a window system whenever one is asked for. It can also be made by name, also where there is an X server. Each window
 * has a context of its own; several windows may be used in turn, and each from one thread at a
 * time.
 *
 * From release 9.4 VTK chooses such a window by itself, and this class does not exist.
 *
 * When no context can be made, an error is reported and Render does nothing; SupportsOpenGL tells.
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
   * Makes the context, if there is none yet, and VTK's state for it. Rendering does this by itself.
   */
  void Initialize() override;

  /**
   * Frees what VTK holds in the context, then the context. The next Render begins anew.
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
   * Makes the context current, and takes back what was current before. An actor that two windows share
   * releases its resources in the other one's context in between. Calls nest.
   */
  void PushContext() override;
  void PopContext() override;
  ///@}

  ///@{
  /**
   * Whether a context can be made (it is made), and that it is not a direct one.
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

private:
  vtkOSMesaRenderWindow(const vtkOSMesaRenderWindow&) = delete;
  void operator=(const vtkOSMesaRenderWindow&) = delete;

  struct InternalState;
  std::unique_ptr<InternalState> Internals;
};

#endif
