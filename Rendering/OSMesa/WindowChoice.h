// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WindowChoice_h
#define freespace_WindowChoice_h

namespace freespace
{

/// What the environment variable FREESPACE_WINDOW asks for: `osmesa`, `display`, or else nothing.
enum class WindowWish
{
  Automatic,
  OSMesa,
  Display
};
WindowWish WantedWindow();

/// Run once, when the module is loaded and before its object factory is registered. Where an X
/// server answers, VTK's own window is left alone and false is returned: the factory is then not
/// registered, and people who sit before a screen keep their interactive windows. Elsewhere VTK's
/// window could not be opened: the factories registered so far are told not to make it. FREESPACE_WINDOW decides
/// instead, where it is set.
bool ChooseOSMesa();

}

#endif
