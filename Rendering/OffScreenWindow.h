// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OffScreenWindow_h
#define freespace_OffScreenWindow_h

#include <vtkSmartPointer.h>

class vtkRenderWindow;

namespace freespace
{

/// A window for pictures, not shown. Before VTK 9.4 it is a vtkOSMesaRenderWindow, whether an X server answers or not,
/// so that a picture does not depend on it; VTK's own where the environment variable FREESPACE_WINDOW is `display`.
vtkSmartPointer<vtkRenderWindow> NewOffScreenWindow();

}

#endif
