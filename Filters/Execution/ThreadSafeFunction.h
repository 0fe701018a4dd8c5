// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ThreadSafeFunction_h
#define freespace_ThreadSafeFunction_h

#include "vtkFreespaceFiltersModule.h"

class vtkImplicitFunction;

namespace freespace
{

/// Whether a function can be evaluated on several threads at once: VTK's own of second order or less, and
/// combinations of these, without a transform. Of others, subclasses among them, nothing is known.
VTKFREESPACEFILTERS_EXPORT bool IsThreadSafeFunction(vtkImplicitFunction* function);

}

#endif
