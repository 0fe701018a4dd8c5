// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceSampleFilter.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Data/ViewInput.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Freespace/FreespaceUnion.h"
#include "vtkFreespaceUnion.h"

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <memory>

vtkStandardNewMacro(vtkFreespaceSampleFilter);

namespace
{

constexpr double ShareOfBuilding = 0.5; // of the time
constexpr vtkIdType BlockSize = 1024;   // points

void Sample(const freespace::FreespaceUnion& phi, vtkDataSet* points, double* values,
  const freespace::Progress& progress)
{
  const vtkIdType count = points->GetNumberOfPoints();
  freespace::ParallelForWithProgress(static_cast<std::size_t>((count + BlockSize - 1) / BlockSize),
    freespace::SMPParallelFor, progress,
    [&](std::size_t block, const freespace::CancellationFlag& stop)
    {
      const vtkIdType begin = static_cast<vtkIdType>(block) * BlockSize;
      for (vtkIdType i = begin; i < std::min(begin + BlockSize, count); ++i)
      {
        freespace::ThrowIfCancelled(stop);
        Eigen::Vector3d point;
        points->GetPoint(i, point.data());
        values[i] = std::clamp(phi.Value(point), -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
      }
    });
}

}

vtkFreespaceSampleFilter::vtkFreespaceSampleFilter()
{
  this->SetNumberOfInputPorts(2);
}

vtkFreespaceSampleFilter::~vtkFreespaceSampleFilter() = default;

void vtkFreespaceSampleFilter::SetMinimumViews(int views)
{
  if (this->FreespaceUnion->GetMinimumViews() != views)
  {
    this->FreespaceUnion->SetMinimumViews(views);
    this->Modified();
  }
}

int vtkFreespaceSampleFilter::GetMinimumViews()
{
  return this->FreespaceUnion->GetMinimumViews();
}

void vtkFreespaceSampleFilter::SetHullMargin(double margin)
{
  if (this->FreespaceUnion->GetHullMargin() != margin)
  {
    this->FreespaceUnion->SetHullMargin(margin);
    this->Modified();
  }
}

double vtkFreespaceSampleFilter::GetHullMargin()
{
  return this->FreespaceUnion->GetHullMargin();
}

int vtkFreespaceSampleFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  freespace::AcceptViews(info);
  return 1;
}

// Every piece of the points needs all maps.
int vtkFreespaceSampleFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Superclass::RequestUpdateExtent(request, inputVector, outputVector))
  {
    return 0;
  }
  vtkInformation* maps = inputVector[1]->GetInformationObject(0);
  maps->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  maps->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  maps->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

int vtkFreespaceSampleFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    vtkDataSet* input = vtkDataSet::GetData(inputVector[0]);
    vtkDataSet* output = vtkDataSet::GetData(outputVector);
    // The very object: for the next block of a composite input the function is built already.
    this->FreespaceUnion->SetMaps(freespace::ViewsOf(inputVector[1]));
    const std::shared_ptr<const freespace::FreespaceUnion> phi =
      this->FreespaceUnion->GetCore(progress.Part(0.0, ShareOfBuilding));
    if (!phi)
    {
      throw freespace::Error("The disparity maps are not valid.");
    }
    vtkNew<vtkDoubleArray> values;
    values->SetName("Phi");
    values->SetNumberOfTuples(input->GetNumberOfPoints());
    Sample(*phi, input, values->GetPointer(0), progress.Part(ShareOfBuilding, 1.0));
    output->ShallowCopy(input);
    output->GetPointData()->AddArray(values);
    output->GetPointData()->SetActiveScalars("Phi");
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkFreespaceSampleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FreespaceUnion:\n";
  this->FreespaceUnion->PrintSelf(os, indent.GetNextIndent());
}
