// SPDX-License-Identifier: BSD-3-Clause
#include "Data/BlockMaps.h"

#include "Data/ViewBlocks.h"
#include "Data/ViewEdits.h"

#include <vtkMultiBlockDataSet.h>

namespace freespace
{

BlockMaps::Identity BlockMaps::Identity::Of(vtkMultiBlockDataSet* maps, std::size_t i)
{
  vtkDataObject* block = maps->GetBlock(static_cast<unsigned int>(i));
  return { block, block ? block->GetMTime() : 0 };
}

const SharedMaps& BlockMaps::Of(
  vtkMultiBlockDataSet* maps, const ParallelFor& parallelFor, const Progress& progress)
{
  const std::size_t count = maps->GetNumberOfBlocks();
  std::vector<Identity> blocks(count);
  SharedMaps shared(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    blocks[i] = Identity::Of(maps, i);
    if (blocks[i].block && i < this->Blocks.size() && blocks[i] == this->Blocks[i])
    {
      shared[i] = this->Maps[i];
    }
  }
  this->Maps = CompleteMaps(
    std::move(shared),
    [maps](std::size_t i) { return MapFromBlocks(maps, static_cast<unsigned int>(i)); },
    parallelFor, progress);
  this->Blocks = std::move(blocks);
  return this->Maps;
}

vtkSmartPointer<vtkMultiBlockDataSet> BlockMaps::Remove(vtkMultiBlockDataSet* maps, int index)
{
  auto others = WithoutView(maps, index);
  const std::size_t removed = static_cast<std::size_t>(index);
  this->Blocks.resize(maps->GetNumberOfBlocks());
  this->Maps.resize(this->Blocks.size());
  for (std::size_t i = 0; i < this->Blocks.size(); ++i)
  {
    // Those that were modified since they were read are read again.
    const bool isKept = i != removed && this->Blocks[i] == Identity::Of(maps, i);
    this->Blocks[i] = isKept ? Identity::Of(others, i - (i > removed)) : Identity();
  }
  this->Blocks.erase(this->Blocks.begin() + index);
  this->Maps.erase(this->Maps.begin() + index);
  return others;
}

void BlockMaps::Clear()
{
  this->Blocks.clear();
  this->Maps.clear();
}

}
