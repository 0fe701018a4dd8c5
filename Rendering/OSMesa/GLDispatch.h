// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GLDispatch_h
#define freespace_GLDispatch_h

namespace freespace
{

/// Ends the use of a GLX context in this thread. Before a context of OSMesa is made current: both of Mesa's libraries keep
/// the current context in one place. It is made current again by whom it belongs to.
void LeaveGLX();

/// Sends this thread's calls of libGL's and libOpenGL's functions (glClear and so on) to libOSMesa.
///
/// They are stubs of GLVND, which looks the function up in a table that belongs to the thread and
/// that glXMakeCurrent or eglMakeCurrent would have set. OSMesa knows nothing of GLVND, so it is
/// done here. Returns false when the GLVND of this machine is of another binary interface.
bool DispatchToOSMesa();

/// Whether this thread's calls go to libOSMesa.
bool DispatchesToOSMesa();

/// Undoes DispatchToOSMesa, so that GLX or EGL can make a context of theirs current in this thread.
void StopDispatch();

}

#endif
