// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureSupportFilter.h"

#include "Common/ParallelForWithProgress.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Disparity/FeatureSupport.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <iterator>
#include <vector>

vtkStandardNewMacro(vtkFeatureSupportFilter);

vtkFeatureSupportFilter::vtkFeatureSupportFilter()
{
  const freespace::FeatureSupportOptions options;
  this->Radius = options.radius;
  this->RadiusInSpacings = options.spacings;
  this->MinimumNeighbors = options.minimumNeighbors;
  this->DisparityTolerance = options.disparityTolerance;
}

namespace
{

// Line segments between surviving points, with their new ids.
void CopyLines(vtkPolyData* input, const std::vector<vtkIdType>& newId, vtkPolyData* output)
{
  vtkNew<vtkCellArray> lines;
  vtkCellArray* chains = input->GetLines();
  for (vtkIdType cell = 0; cell < chains->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    chains->GetCellAtId(cell, size, ids);
    for (vtkIdType i = 1; i < size; ++i)
    {
      const vtkIdType segment[2] = { newId[ids[i - 1]], newId[ids[i]] };
      if (segment[0] >= 0 && segment[1] >= 0)
      {
        lines->InsertNextCell(2, segment);
      }
    }
  }
  output->SetLines(lines);
}

vtkSmartPointer<vtkPolyData> KeepSupported(
  vtkPolyData* input, const std::vector<int>& support, int minimum)
{
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->GetFieldData()->PassData(input->GetFieldData());
  output->GetPointData()->CopyAllocate(input->GetPointData());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIntArray> counts;
  counts->SetName("Support");
  std::vector<vtkIdType> newId(support.size(), -1);
  for (std::size_t i = 0; i < support.size(); ++i)
  {
    if (support[i] >= minimum)
    {
      const vtkIdType from = static_cast<vtkIdType>(i);
      const vtkIdType id = newId[i] = points->InsertNextPoint(input->GetPoint(from));
      output->GetPointData()->CopyData(input->GetPointData(), from, id);
      vertices->InsertNextCell(1, &id);
      counts->InsertNextValue(support[i]);
    }
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
  output->GetPointData()->AddArray(counts);
  CopyLines(input, newId, output);
  return output;
}

}

int vtkFeatureSupportFilter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

int vtkFeatureSupportFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  freespace::FeatureSupportOptions options;
  options.radius = this->Radius;
  options.spacings = this->RadiusInSpacings;
  options.minimumNeighbors = this->MinimumNeighbors;
  options.disparityTolerance = this->DisparityTolerance;
  try
  {
    const auto input = freespace::ViewsOf(inputVector[0]);
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    const std::vector<freespace::View> views = freespace::ViewsFromBlocks(input);
    std::vector<double> work;
    std::transform(views.begin(), views.end(), std::back_inserter(work),
      [](const freespace::View& view) { return static_cast<double>(view.points.size()); });
    std::vector<std::vector<int>> support(views.size());
    freespace::ParallelForWithProgress(work, freespace::SMPParallelFor, progress,
      [&](std::size_t i, const freespace::CancellationFlag&)
      { support[i] = freespace::CountSupport(views[i], options); });
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const unsigned int index = static_cast<unsigned int>(i);
      freespace::SetNamedBlock(output, index, views[i].name,
        KeepSupported(
          vtkPolyData::SafeDownCast(input->GetBlock(index)), support[i], this->MinimumNeighbors));
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkFeatureSupportFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusInSpacings: " << this->RadiusInSpacings << "\n";
  os << indent << "MinimumNeighbors: " << this->MinimumNeighbors << "\n";
  os << indent << "DisparityTolerance: " << this->DisparityTolerance << "\n";
}
