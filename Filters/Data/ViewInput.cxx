// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewInput.h"

#include "Common/Error.h"

#include <vtkAlgorithm.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>

#include <string>

namespace freespace
{

namespace
{

vtkSmartPointer<vtkMultiBlockDataSet> BlocksOf(vtkPartitionedDataSetCollection* collection)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(collection->GetNumberOfPartitionedDataSets());
  for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkPartitionedDataSet* parts = collection->GetPartitionedDataSet(i);
    const unsigned int count = parts ? parts->GetNumberOfPartitions() : 0;
    if (count > 1)
    {
      throw Error("View " + std::to_string(i) + " has " + std::to_string(count) +
        " partitions, a view is one.");
    }
    blocks->SetBlock(i, count == 1 ? parts->GetPartition(0) : nullptr);
    if (collection->HasMetaData(i) && collection->GetMetaData(i)->Has(vtkCompositeDataSet::NAME()))
    {
      blocks->GetMetaData(i)->Set(
        vtkCompositeDataSet::NAME(), collection->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()));
    }
  }
  return blocks;
}

}

void AcceptViews(vtkInformation* port)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
}

vtkSmartPointer<vtkMultiBlockDataSet> ViewsOf(vtkDataObject* data)
{
  if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(data))
  {
    return BlocksOf(collection);
  }
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data);
  if (data && !blocks)
  {
    throw Error(
      std::string("Views are a vtkMultiBlockDataSet, and not a ") + data->GetClassName() + ".");
  }
  return blocks;
}

vtkSmartPointer<vtkMultiBlockDataSet> ViewsOf(vtkInformationVector* port, int connection)
{
  return ViewsOf(vtkDataObject::GetData(port, connection));
}

}
