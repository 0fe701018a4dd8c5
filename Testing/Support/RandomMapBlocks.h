// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RandomMapBlocks_h
#define freespace_RandomMapBlocks_h

#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

namespace freespace
{

/// RandomMaps as blocks.
inline vtkSmartPointer<vtkMultiBlockDataSet> MakeMaps(unsigned int seed, int count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const DisparityMap& map : RandomMaps(seed, count))
  {
    SetNamedBlock(blocks, blocks->GetNumberOfBlocks(), map.name, BlockFromMap(map));
  }
  return blocks;
}

}

#endif
