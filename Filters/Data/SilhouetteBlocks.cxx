// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SilhouetteBlocks.h"

#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace freespace
{

bool IsSilhouette(vtkDataObject* object)
{
  auto* block = vtkPolyData::SafeDownCast(object);
  if (!block || block->GetNumberOfPolys() == 0)
  {
    return false;
  }
  vtkDataArray* source = block->GetPointData()->GetArray("SourceView");
  if (!source || source->GetNumberOfComponents() != 1 || source->GetNumberOfTuples() == 0)
  {
    return false;
  }
  double range[2];
  source->GetRange(range);
  return range[0] == -1 && range[1] == -1;
}

unsigned int NumberOfSilhouettes(vtkMultiBlockDataSet* blocks)
{
  unsigned int count = 0;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    count += IsSilhouette(blocks->GetBlock(i)) ? 1 : 0;
  }
  return count;
}

namespace
{

void Append(vtkMultiBlockDataSet* from, unsigned int index, vtkMultiBlockDataSet* to)
{
  const unsigned int next = to->GetNumberOfBlocks();
  to->SetBlock(next, from->GetBlock(index));
  if (from->HasMetaData(index))
  {
    to->GetMetaData(next)->Copy(from->GetMetaData(index));
  }
}

}

vtkSmartPointer<vtkMultiBlockDataSet> WithoutSilhouettes(vtkMultiBlockDataSet* blocks)
{
  if (NumberOfSilhouettes(blocks) == 0)
  {
    return blocks;
  }
  auto views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    if (!IsSilhouette(blocks->GetBlock(i)))
    {
      Append(blocks, i, views);
    }
  }
  return views;
}

void AppendSilhouettes(vtkMultiBlockDataSet* from, vtkMultiBlockDataSet* to)
{
  for (unsigned int i = 0; i < from->GetNumberOfBlocks(); ++i)
  {
    if (IsSilhouette(from->GetBlock(i)))
    {
      Append(from, i, to);
    }
  }
}

}
