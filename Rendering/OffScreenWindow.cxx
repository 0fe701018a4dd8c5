// SPDX-License-Identifier: BSD-3-Clause
#include "OffScreenWindow.h"

#include <vtkRenderWindow.h>
#include <vtkVersionMacros.h>

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include "OSMesa/WindowChoice.h"
#include "vtkOSMesaRenderWindow.h"
#endif

namespace freespace
{

vtkSmartPointer<vtkRenderWindow> NewOffScreenWindow()
{
  vtkSmartPointer<vtkRenderWindow> window;
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
  if (WantedWindow() != WindowWish::Display)
  {
    window = vtkSmartPointer<vtkOSMesaRenderWindow>::New();
  }
#endif
  if (!window)
  {
    window = vtkSmartPointer<vtkRenderWindow>::New();
  }
  window->SetOffScreenRendering(1);
  return window;
}

}
