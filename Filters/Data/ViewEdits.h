// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewEdits_h
#define freespace_ViewEdits_h

#include "vtkFreespaceFiltersModule.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// What SourceView says of points from a view that is no longer there: they are still features, of another view.
constexpr int RemovedView = 0x7fffffff;

/// The index of the first block with a name; throws Error where there is none. A block without a name has that of
/// BlockName.
VTKFREESPACEFILTERS_EXPORT int FindView(vtkMultiBlockDataSet* maps, const std::string& name);

/// The maps with one more at the end, or in place of the one of its name. All other blocks are the same objects.
/// SourceView of the new one is as in the result; or, with a sourceIndex of 0 or more, has this for the points
/// of the view itself, and is changed to what they have in the result. Throws Error without a map.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> WithView(
  vtkMultiBlockDataSet* maps, const std::string& name, vtkPolyData* map, int sourceIndex);

/// The maps without one. SourceView of the others counts without it; where it names it, it becomes RemovedView.
/// Blocks in which nothing changes are the same objects. Throws Error where there is none of this index.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> WithoutView(
  vtkMultiBlockDataSet* maps, int index);

}

#endif
