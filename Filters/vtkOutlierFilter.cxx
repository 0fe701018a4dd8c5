// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOutlierFilter.h"

#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Disparity/Outliers/Outliers.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <vector>

vtkStandardNewMacro(vtkOutlierFilter);

vtkOutlierFilter::vtkOutlierFilter()
{
  const freespace::OutlierOptions options;
  this->Support = options.support;
  this->SharingViews = options.sharingViews;
  this->SupportRadius = options.radius;
  this->SupportTolerance = options.tolerance;
  this->SeeThroughViews = options.seeThroughViews;
  this->ViolatingFeatures = options.violatingFeatures;
}

freespace::OutlierOptions vtkOutlierFilter::Outliers() const
{
  freespace::OutlierOptions options;
  options.support = this->Support;
  options.sharingViews = this->SharingViews;
  options.radius = this->SupportRadius;
  options.tolerance = this->SupportTolerance;
  options.seeThroughViews = this->SeeThroughViews;
  options.violatingFeatures = this->ViolatingFeatures;
  return options;
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

vtkSmartPointer<vtkPolyData> KeepAccepted(vtkPolyData* input, const std::vector<char>& accepted)
{
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->GetFieldData()->PassData(input->GetFieldData());
  output->GetPointData()->CopyAllocate(input->GetPointData());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  std::vector<vtkIdType> newId(accepted.size(), -1);
  for (std::size_t i = 0; i < accepted.size(); ++i)
  {
    if (accepted[i])
    {
      const vtkIdType from = static_cast<vtkIdType>(i);
      const vtkIdType id = newId[i] = points->InsertNextPoint(input->GetPoint(from));
      output->GetPointData()->CopyData(input->GetPointData(), from, id);
      vertices->InsertNextCell(1, &id);
    }
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
  CopyLines(input, newId, output);
  return output;
}

}

int vtkOutlierFilter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

int vtkOutlierFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  try
  {
    const auto given = freespace::ViewsOf(inputVector[0]);
    const auto input = freespace::WithoutSilhouettes(given);
    const std::vector<freespace::View> views = freespace::ViewsFromBlocks(input);
    const auto accepted = freespace::AcceptedFeatures(
      views, this->Outliers(), {}, freespace::SMPParallelFor, freespace::AlgorithmProgress(this));
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const unsigned int index = static_cast<unsigned int>(i);
      freespace::SetNamedBlock(output, index, views[i].name,
        KeepAccepted(vtkPolyData::SafeDownCast(input->GetBlock(index)), accepted[i]));
    }
    freespace::AppendSilhouettes(given, output);
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkOutlierFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Support: " << this->Support << "\n";
  os << indent << "SharingViews: " << this->SharingViews << "\n";
  os << indent << "SupportRadius: " << this->SupportRadius << "\n";
  os << indent << "SupportTolerance: " << this->SupportTolerance << "\n";
  os << indent << "SeeThroughViews: " << this->SeeThroughViews << "\n";
  os << indent << "ViolatingFeatures: " << this->ViolatingFeatures << "\n";
}
