// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBisectionContourFilter.h"

#include "AlgorithmProgress.h"
#include "BisectionContour.h"
#include "FreespaceUnion.h"
#include "SMPParallelFor.h"
#include "vtkFreespaceUnion.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdTypeArray.h>
#include <vtkImplicitFunction.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

vtkStandardNewMacro(vtkBisectionContourFilter);

namespace
{

/// Any function as a field: it can only be asked point by point.
class FunctionField : public freespace::ContourField
{
public:
  explicit FunctionField(vtkImplicitFunction* function)
    : Function(function)
  {
  }

  bool IsFree(const Eigen::Vector3d& point, const freespace::FieldScope&) const override
  {
    return this->Function->FunctionValue(point.data()) > 0;
  }

private:
  vtkImplicitFunction* Function;
};

Eigen::AlignedBox3d MakeBox(const double b[6])
{
  return Eigen::AlignedBox3d(Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5]));
}

vtkSmartPointer<vtkPoints> MakePoints(const freespace::ContourMesh& mesh)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  return points;
}

vtkSmartPointer<vtkCellArray> MakeTriangles(const freespace::ContourMesh& mesh)
{
  vtkNew<vtkIdTypeArray> offsets, corners;
  const vtkIdType n = static_cast<vtkIdType>(mesh.triangles.size());
  offsets->SetNumberOfValues(n + 1);
  corners->SetNumberOfValues(3 * n);
  for (vtkIdType t = 0; t < n; ++t)
  {
    offsets->SetValue(t, 3 * t);
    for (int i = 0; i < 3; ++i)
    {
      corners->SetValue(3 * t + i, mesh.triangles[t][i]);
    }
  }
  offsets->SetValue(n, 3 * n);
  auto triangles = vtkSmartPointer<vtkCellArray>::New();
  triangles->SetData(offsets, corners);
  return triangles;
}

void AddLabels(const freespace::ContourMesh& mesh, vtkPolyData* output)
{
  const vtkIdType n = static_cast<vtkIdType>(mesh.triangles.size());
  vtkNew<vtkIntArray> view;
  view->SetName("View");
  view->SetNumberOfValues(n);
  vtkNew<vtkUnsignedCharArray> kind;
  kind->SetName("Kind");
  kind->SetNumberOfValues(n);
  for (vtkIdType t = 0; t < n; ++t)
  {
    view->SetValue(t, mesh.view[t]);
    kind->SetValue(t, static_cast<unsigned char>(mesh.kind[t]));
  }
  output->GetCellData()->AddArray(view);
  output->GetCellData()->AddArray(kind);
}

}

vtkBisectionContourFilter::vtkBisectionContourFilter()
{
  this->SetNumberOfInputPorts(0);
}

vtkBisectionContourFilter::~vtkBisectionContourFilter() = default;

void vtkBisectionContourFilter::SetImplicitFunction(vtkImplicitFunction* function)
{
  if (this->ImplicitFunction != function)
  {
    this->ImplicitFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkBisectionContourFilter::GetImplicitFunction()
{
  return this->ImplicitFunction;
}

vtkMTimeType vtkBisectionContourFilter::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ImplicitFunction ? std::max(own, this->ImplicitFunction->GetMTime()) : own;
}

int vtkBisectionContourFilter::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!this->ImplicitFunction)
  {
    vtkErrorMacro("There is no implicit function to contour.");
    return 0;
  }
  freespace::ContourOptions options;
  options.cells = this->Cells;
  options.tolerance = this->Tolerance;
  options.clearance = this->Clearance;
  Eigen::AlignedBox3d bounds = MakeBox(this->Bounds);
  auto* freespaceUnion = vtkFreespaceUnion::SafeDownCast(this->ImplicitFunction);
  std::shared_ptr<const freespace::FreespaceUnion> core;
  if (freespaceUnion)
  {
    core = freespaceUnion->GetCore();
    if (!core)
    {
      vtkErrorMacro("The free space union has no valid disparity maps.");
      return 0;
    }
  }
  // A transformed union is contoured like any other function.
  const bool direct = core && !freespaceUnion->GetTransform();
  if (bounds.isEmpty() && direct)
  {
    bounds = core->Hull().Bounds();
  }
  else if (bounds.isEmpty())
  {
    vtkErrorMacro("The function does not tell its bounds: set Bounds.");
    return 0;
  }
  try
  {
    const FunctionField function(this->ImplicitFunction);
    const freespace::ContourField& field =
      direct ? static_cast<const freespace::ContourField&>(*core) : function;
    const freespace::ContourMesh mesh = freespace::BisectionContour(
      field, bounds, options, freespace::AlgorithmProgress(this), freespace::SMPParallelFor);
    output->SetPoints(MakePoints(mesh));
    output->SetPolys(MakeTriangles(mesh));
    if (direct)
    {
      AddLabels(mesh, output);
    }
  }
  catch (const freespace::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkBisectionContourFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImplicitFunction: " << this->ImplicitFunction.Get() << "\n";
  os << indent << "Bounds:";
  for (double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "Cells: " << this->Cells << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Clearance: " << this->Clearance << "\n";
}
