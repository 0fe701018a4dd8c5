// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewEdits.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"

#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <functional>

namespace freespace
{

namespace
{

// A block with other indices in SourceView, which shares all else; the block itself where none changes. An array that
// holds no indices is left to be found out when the map is read.
vtkSmartPointer<vtkDataObject> WithSources(
  vtkDataObject* block, const std::function<double(double)>& changed)
{
  vtkPolyData* map = vtkPolyData::SafeDownCast(block);
  vtkDataArray* source = map ? map->GetPointData()->GetArray("SourceView") : nullptr;
  if (!source || source->GetNumberOfComponents() != 1)
  {
    return block;
  }
  vtkNew<vtkIntArray> now;
  now->SetName(source->GetName());
  now->SetNumberOfValues(source->GetNumberOfTuples());
  bool isSame = true;
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
  {
    const double before = source->GetComponent(i, 0);
    if (!(before >= -1 && before <= RemovedView))
    {
      return block;
    }
    now->SetValue(i, static_cast<int>(changed(before)));
    isSame = isSame && now->GetValue(i) == before;
  }
  if (isSame)
  {
    return block;
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(map);
  result->GetPointData()->AddArray(now);
  return result;
}

// The first block with a name; -1: there is none.
int IndexOf(vtkMultiBlockDataSet* maps, const std::string& name)
{
  const int count = static_cast<int>(maps->GetNumberOfBlocks());
  int index = 0;
  while (index < count && BlockName(maps, static_cast<unsigned int>(index)) != name)
  {
    ++index;
  }
  return index < count ? index : -1;
}

// A block as it is: also one that is no map, which is an error of the update.
void Append(vtkMultiBlockDataSet* maps, const std::string& name, vtkDataObject* block)
{
  const unsigned int index = maps->GetNumberOfBlocks();
  maps->SetNumberOfBlocks(index + 1);
  maps->SetBlock(index, block);
  maps->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

}

int FindView(vtkMultiBlockDataSet* maps, const std::string& name)
{
  const int index = IndexOf(maps, name);
  if (index < 0)
  {
    throw Error("There is no view '" + name + "'.");
  }
  return index;
}

vtkSmartPointer<vtkMultiBlockDataSet> WithView(
  vtkMultiBlockDataSet* maps, const std::string& name, vtkPolyData* map, int sourceIndex)
{
  if (!map)
  {
    throw Error("There is no map to be added as view '" + name + "'.");
  }
  auto result = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const int count = static_cast<int>(maps->GetNumberOfBlocks());
  const int found = IndexOf(maps, name), index = found < 0 ? count : found;
  const auto placed = WithSources(map,
    [&](double source)
    {
      return sourceIndex < 0 || sourceIndex == index ? source
        : source == sourceIndex                      ? index
        : source == index                            ? RemovedView
                                                     : source;
    });
  for (int i = 0; i < std::max(count, index + 1); ++i)
  {
    const unsigned int at = static_cast<unsigned int>(i);
    Append(result, i == index ? name : BlockName(maps, at),
      i == index ? placed.Get() : maps->GetBlock(at));
  }
  return result;
}

vtkSmartPointer<vtkMultiBlockDataSet> WithoutView(vtkMultiBlockDataSet* maps, int index)
{
  const int count = static_cast<int>(maps->GetNumberOfBlocks());
  if (index < 0 || index >= count)
  {
    throw Error("There is no view " + std::to_string(index) + " of " + std::to_string(count) + ".");
  }
  auto result = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const auto without = [&](double source)
  {
    return source == index                      ? RemovedView
      : source > index && source != RemovedView ? source - 1
                                                : source;
  };
  for (int i = 0; i < count; ++i)
  {
    const unsigned int at = static_cast<unsigned int>(i);
    if (i != index)
    {
      Append(result, BlockName(maps, at), WithSources(maps->GetBlock(at), without));
    }
  }
  return result;
}

}
