// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFitSurfaceFilter.h"

#include "Data/PointNormals.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Mesh/Fit/FitSurface.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkFitSurfaceFilter);

namespace
{

std::vector<Eigen::Vector3d> PointsOf(vtkPolyData* surface)
{
  std::vector<Eigen::Vector3d> points(surface->GetNumberOfPoints());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    surface->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    if (!points[i].allFinite())
    {
      throw freespace::Error("The surface has a point that is not finite.");
    }
  }
  return points;
}

std::vector<std::array<std::int32_t, 3>> TrianglesOf(vtkPolyData* surface)
{
  if (surface->GetNumberOfCells() != surface->GetNumberOfPolys())
  {
    throw freespace::Error("The surface has cells that are no polygons.");
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(surface->GetNumberOfPolys());
  vtkCellArray* polys = surface->GetPolys();
  for (vtkIdType t = 0; t < polys->GetNumberOfCells(); ++t)
  {
    vtkIdType size;
    const vtkIdType* corners;
    polys->GetCellAtId(t, size, corners);
    if (size != 3)
    {
      throw freespace::Error("The surface has a polygon of " + std::to_string(size) +
        " corners, only triangles can be fitted.");
    }
    triangles.push_back({ static_cast<std::int32_t>(corners[0]),
      static_cast<std::int32_t>(corners[1]), static_cast<std::int32_t>(corners[2]) });
  }
  return triangles;
}

// Each view's own features: those that others lent it are their own.
std::vector<freespace::SeenFeature> FeaturesOf(vtkMultiBlockDataSet* blocks)
{
  std::vector<freespace::SeenFeature> features;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    const freespace::DisparityMap map = freespace::MapFromBlocks(blocks, i);
    const Eigen::Vector3d eye = map.camera.Center();
    for (std::size_t p = 0; p < map.points.size(); ++p)
    {
      if (map.sourceView[p] == static_cast<int>(i) && map.points[p].allFinite())
      {
        const double deviation =
          map.deviations.empty() ? 0 : map.deviations[p] * map.camera.Depth(map.points[p]);
        features.push_back({ map.points[p], map.points[p] - eye, deviation });
      }
    }
  }
  return features;
}

}

vtkFitSurfaceFilter::vtkFitSurfaceFilter()
{
  const freespace::FitSurfaceOptions options;
  this->Rounds = options.rounds;
  this->NormalIterations = options.normals.iterations;
  this->NormalDeviation = options.normals.deviation;
  this->Waviness = options.waviness;
  this->Reach = options.reach;
  this->MostMove = options.mostMove;
  this->SetNumberOfInputPorts(2);
}

int vtkFitSurfaceFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  }
  else
  {
    freespace::AcceptViews(info);
  }
  return 1;
}

int vtkFitSurfaceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    const auto maps = freespace::ViewsOf(inputVector[1]);
    freespace::FitSurfaceOptions options;
    options.rounds = this->Rounds;
    options.normals.iterations = this->NormalIterations;
    options.normals.deviation = this->NormalDeviation;
    options.waviness = this->Waviness;
    options.reach = this->Reach;
    options.mostMove = this->MostMove;
    options.isSingle = input->GetPoints() && input->GetPoints()->GetDataType() == VTK_FLOAT;
    options.Check();
    std::vector<Eigen::Vector3d> fitted = PointsOf(input);
    freespace::FitSurface(fitted, TrianglesOf(input), FeaturesOf(maps), options,
      freespace::AlgorithmProgress(this), freespace::SMPParallelFor);
    output->ShallowCopy(input);
    vtkNew<vtkPoints> points;
    points->SetDataType(options.isSingle ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(fitted.size()));
    for (std::size_t i = 0; i < fitted.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), fitted[i].data());
    }
    output->SetPoints(points);
    if (input->GetPointData()->GetNormals())
    {
      freespace::ComputePointNormals(output);
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkFitSurfaceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Rounds: " << this->Rounds << "\n";
  os << indent << "NormalIterations: " << this->NormalIterations << "\n";
  os << indent << "NormalDeviation: " << this->NormalDeviation << "\n";
  os << indent << "Waviness: " << this->Waviness << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "MostMove: " << this->MostMove << "\n";
}
