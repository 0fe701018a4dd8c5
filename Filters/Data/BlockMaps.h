// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BlockMaps_h
#define freespace_BlockMaps_h

#include "Freespace/MapFreespace.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

class vtkDataObject;
class vtkMultiBlockDataSet;

namespace freespace
{

/// The maps of blocks, as a union has them, kept for its next building: a block that is the same object with the same
/// modification time, at the same place, is not read again. Does not keep the blocks alive.
class BlockMaps
{
public:
  /// The maps of all blocks, kept from now on. Throws as MapFromBlocks and CompleteMaps do; keeps what it had then.
  const SharedMaps& Of(
    vtkMultiBlockDataSet* maps, const ParallelFor& parallelFor, const Progress& progress);

  /// WithoutView. The other blocks are recognized in its result, in which no more than their indices changed.
  vtkSmartPointer<vtkMultiBlockDataSet> Remove(vtkMultiBlockDataSet* maps, int index);

  void Clear();

private:
  // A block; the time of modification is never that of another object.
  struct Identity
  {
    const vtkDataObject* block = nullptr;
    vtkMTimeType time = 0;

    static Identity Of(vtkMultiBlockDataSet* maps, std::size_t i);
    bool operator==(const Identity& other) const
    {
      return this->block == other.block && this->time == other.time;
    }
  };

  std::vector<Identity> Blocks;
  SharedMaps Maps;
};

}

#endif
