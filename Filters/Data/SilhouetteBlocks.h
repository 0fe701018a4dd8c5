// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SilhouetteBlocks_h
#define freespace_SilhouetteBlocks_h

#include "vtkFreespaceFiltersModule.h"

#include <vtkSmartPointer.h>

class vtkDataObject;
class vtkMultiBlockDataSet;

namespace freespace
{

/// Silhouettes are blocks beside those of views: the free space that the mask of an image shows, as a disparity map
/// without any feature. They pass through the filters of views as they are, behind the views.

/// Whether a block is a silhouette: it has triangles, and SourceView is -1 for all of its points.
VTKFREESPACEFILTERS_EXPORT bool IsSilhouette(vtkDataObject* block);

VTKFREESPACEFILTERS_EXPORT unsigned int NumberOfSilhouettes(vtkMultiBlockDataSet* blocks);

/// The blocks that are no silhouettes; the same object where none is one.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> WithoutSilhouettes(
  vtkMultiBlockDataSet* blocks);

/// Appends the silhouettes of one data set to another one.
VTKFREESPACEFILTERS_EXPORT void AppendSilhouettes(
  vtkMultiBlockDataSet* from, vtkMultiBlockDataSet* to);

}

#endif
