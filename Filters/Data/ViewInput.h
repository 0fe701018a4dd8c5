// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewInput_h
#define freespace_ViewInput_h

#include "vtkFreespaceFiltersModule.h"

#include <vtkSmartPointer.h>

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkMultiBlockDataSet;

namespace freespace
{

/// Lets an input port take views as a vtkMultiBlockDataSet or as a vtkPartitionedDataSetCollection, which
/// replaces it in later releases of VTK.
VTKFREESPACEFILTERS_EXPORT void AcceptViews(vtkInformation* port);

/// The views of a data object as blocks: of a vtkMultiBlockDataSet itself; of a
/// vtkPartitionedDataSetCollection, whose data sets are the views and have one partition each, the
/// partitions under the names of their data sets. Null for null. Throws Error for anything else.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> ViewsOf(vtkDataObject* data);

/// The same for an input of a RequestData.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> ViewsOf(
  vtkInformationVector* port, int connection = 0);

}

#endif
