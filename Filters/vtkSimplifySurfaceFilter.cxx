// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSimplifySurfaceFilter.h"

#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Mesh/SimplifySurface.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

vtkStandardNewMacro(vtkSimplifySurfaceFilter);

namespace
{

/// A label holds both arrays.
constexpr std::int64_t Kinds = 256;

freespace::LabelledSurface ReadSurface(vtkPolyData* input)
{
  freespace::LabelledSurface surface;
  surface.points.resize(input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, surface.points[i].data());
  }
  auto* views = vtkIntArray::SafeDownCast(input->GetCellData()->GetArray("View"));
  auto* kinds = vtkUnsignedCharArray::SafeDownCast(input->GetCellData()->GetArray("Kind"));
  if (input->GetNumberOfCells() != input->GetNumberOfPolys())
  {
    throw freespace::Error("The surface has cells that are no polygons.");
  }
  vtkCellArray* polys = input->GetPolys();
  for (vtkIdType t = 0; t < polys->GetNumberOfCells(); ++t)
  {
    vtkIdType size;
    const vtkIdType* corners;
    polys->GetCellAtId(t, size, corners);
    if (size != 3)
    {
      throw freespace::Error("The surface has a polygon of " + std::to_string(size) +
        " corners, only triangles can be simplified.");
    }
    surface.triangles.push_back({ static_cast<std::int32_t>(corners[0]),
      static_cast<std::int32_t>(corners[1]), static_cast<std::int32_t>(corners[2]) });
    surface.labels.push_back(
      (views ? views->GetValue(t) : 0) * Kinds + (kinds ? kinds->GetValue(t) : 0));
  }
  return surface;
}

void WriteSurface(
  const freespace::LabelledSurface& surface, vtkPolyData* input, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints() ? input->GetPoints()->GetDataType() : VTK_DOUBLE);
  for (const Eigen::Vector3d& p : surface.points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIntArray> view;
  view->SetName("View");
  vtkNew<vtkUnsignedCharArray> kind;
  kind->SetName("Kind");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& corners = surface.triangles[t];
    const vtkIdType ids[3] = { corners[0], corners[1], corners[2] };
    triangles->InsertNextCell(3, ids);
    const std::int64_t label = surface.labels[t], ofKind = (label % Kinds + Kinds) % Kinds;
    view->InsertNextValue(static_cast<int>((label - ofKind) / Kinds));
    kind->InsertNextValue(static_cast<unsigned char>(ofKind));
  }
  output->SetPoints(points);
  output->SetPolys(triangles);
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(view), static_cast<vtkDataArray*>(kind) })
  {
    if (input->GetCellData()->GetArray(array->GetName()))
    {
      output->GetCellData()->AddArray(array);
    }
  }
}

}

int vtkSimplifySurfaceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    freespace::SimplifyOptions options;
    options.bound = this->Distance;
    options.isSingle = input->GetPoints() && input->GetPoints()->GetDataType() == VTK_FLOAT;
    options.Check();
    const freespace::LabelledSurface surface = ReadSurface(input);
    WriteSurface(freespace::SimplifySurface(
                   surface, options, freespace::AlgorithmProgress(this), freespace::SMPParallelFor),
      input, output);
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkSimplifySurfaceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Distance: " << this->Distance << "\n";
}
