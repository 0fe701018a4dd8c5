// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BlocksFromBytes_h
#define freespace_BlocksFromBytes_h

#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

#include <string_view>

namespace freespace
{

/// Blocks that are nearly views or disparity maps: what bytes say is left out, of another type, of another
/// shape, or of other values.
vtkSmartPointer<vtkMultiBlockDataSet> BlocksFromBytes(std::string_view bytes);

}

#endif
