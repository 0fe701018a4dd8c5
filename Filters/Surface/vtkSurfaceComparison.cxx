// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceComparison.h"

#include "Data/SurfaceMesh.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Mesh/Distance/SurfaceComparison.h"

#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkSurfaceComparison);

namespace
{

void AddDistances(vtkPolyData* surface, const std::vector<double>& distances)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Distance");
  array->SetNumberOfValues(static_cast<vtkIdType>(distances.size()));
  std::copy(distances.begin(), distances.end(), array->GetPointer(0));
  surface->GetPointData()->SetScalars(array);
}

const freespace::SurfaceDistances& From(const freespace::SurfaceComparison& figures, int from)
{
  return from == vtkSurfaceComparison::SurfaceToReference ? figures.ofSurface : figures.ofReference;
}

}

vtkSurfaceComparison::vtkSurfaceComparison()
  : Figures(new freespace::SurfaceComparison)
{
  const freespace::SurfaceComparisonOptions options;
  this->Samples = options.samples;
  this->Bins = options.bins;
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkSurfaceComparison::~vtkSurfaceComparison() = default;

int vtkSurfaceComparison::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkSurfaceComparison::SetLimits(const std::vector<double>& limits)
{
  if (limits != this->Limits)
  {
    this->Limits = limits;
    this->Modified();
  }
}

int vtkSurfaceComparison::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* outputs[2] = { vtkPolyData::GetData(outputVector, 0),
    vtkPolyData::GetData(outputVector, 1) };
  *this->Figures = {};
  try
  {
    freespace::SurfaceComparisonOptions options;
    options.limits = this->Limits;
    options.samples = this->Samples;
    options.bins = this->Bins;
    vtkPolyData* inputs[2] = { vtkPolyData::GetData(inputVector[0]),
      vtkPolyData::GetData(inputVector[1]) };
    *this->Figures = freespace::CompareSurfaces(freespace::MeshFromPolyData(inputs[0]),
      freespace::MeshFromPolyData(inputs[1]), options, freespace::SMPParallelFor,
      freespace::AlgorithmProgress(this));
    for (int i = 0; i < 2; ++i)
    {
      outputs[i]->ShallowCopy(inputs[i]);
      AddDistances(outputs[i], From(*this->Figures, i).atPoints);
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

std::vector<double> vtkSurfaceComparison::GetUsedLimits()
{
  return this->Figures->limits;
}

std::vector<double> vtkSurfaceComparison::GetAccuracy()
{
  return this->Figures->ofSurface.within;
}

std::vector<double> vtkSurfaceComparison::GetCompleteness()
{
  return this->Figures->ofReference.within;
}

std::vector<double> vtkSurfaceComparison::GetF()
{
  std::vector<double> values;
  for (std::size_t i = 0; i < this->Figures->limits.size(); ++i)
  {
    values.push_back(this->Figures->F(i));
  }
  return values;
}

double vtkSurfaceComparison::GetMeanDistance(int from)
{
  return From(*this->Figures, from).mean;
}

double vtkSurfaceComparison::GetRootMeanSquareDistance(int from)
{
  return From(*this->Figures, from).rootMeanSquare;
}

double vtkSurfaceComparison::GetMedianDistance(int from)
{
  return From(*this->Figures, from).median;
}

double vtkSurfaceComparison::GetGreatestDistance(int from)
{
  return From(*this->Figures, from).greatest;
}

double vtkSurfaceComparison::GetMeanAngle(int from)
{
  return From(*this->Figures, from).meanAngle;
}

double vtkSurfaceComparison::GetMedianAngle(int from)
{
  return From(*this->Figures, from).medianAngle;
}

std::vector<double> vtkSurfaceComparison::GetHistogram(int from)
{
  const freespace::SurfaceDistances& figures = From(*this->Figures, from);
  std::vector<double> shares;
  for (std::size_t count : figures.histogram)
  {
    shares.push_back(double(count) / figures.samples);
  }
  return shares;
}

void vtkSurfaceComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Limits:";
  for (double limit : this->Limits)
  {
    os << " " << limit;
  }
  os << "\n" << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Bins: " << this->Bins << "\n";
}
