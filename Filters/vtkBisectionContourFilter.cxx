// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBisectionContourFilter.h"

#include "Contour/BisectionContour.h"
#include "Contour/Lattice/ContourEstimate.h"
#include "Data/Boxes.h"
#include "Data/ObservedTriangles.h"
#include "Data/PointNormals.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/PieceRequest.h"
#include "Execution/SMPParallelFor.h"
#include "Execution/ThreadSafeFunction.h"
#include "Freespace/Changes/UnionChange.h"
#include "Mesh/FeatureGrid.h"
#include "vtkFreespaceUnion.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkImplicitFunction.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <memory>

vtkStandardNewMacro(vtkBisectionContourFilter);

/// The last contour of a union, for the next one.
struct vtkBisectionContourFilter::Memory
{
  freespace::KeptContour Contour;
  std::shared_ptr<const freespace::FreespaceUnion> Union;
};

namespace
{

/// Any function as a field, which is evaluated point by point.
class FunctionField : public freespace::ContourField
{
public:
  explicit FunctionField(vtkImplicitFunction* function)
    : Function(function)
    , IsSafe(freespace::IsThreadSafeFunction(function))
  {
  }

  bool IsFree(const Eigen::Vector3d& point, const freespace::FieldScope&) const override
  {
    return this->Function->FunctionValue(point.data()) > 0;
  }

  freespace::SurfaceLabel Label(const Eigen::Vector3d& free, const Eigen::Vector3d&,
    const freespace::FieldScope&) const override
  {
    freespace::SurfaceLabel label;
    this->Function->FunctionGradient(free.data(), label.normal.data());
    const double length = label.normal.norm();
    label.normal = length > 0 ? Eigen::Vector3d(label.normal / length) : Eigen::Vector3d(0, 0, 0);
    return label;
  }

  bool IsThreadSafe() const override { return this->IsSafe; }

private:
  vtkImplicitFunction* Function;
  bool IsSafe;
};

/// Whether there are features, but no view with a triangle that could carve anything.
bool IsMereHull(const freespace::FreespaceUnion& core)
{
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < core.NumberOfViews(); ++i)
  {
    triangles += core.ViewAt(i).NumberOfTriangles();
  }
  return triangles == 0 && !core.Hull().IsEmpty();
}

/// The output's own arrays, for the core to write into. In 32 bits, which are enough and half the
/// memory.
freespace::ContourArrays AllocateOutput(vtkPolyData* output, vtkTypeInt32Array* corners,
  const freespace::ContourSize& size, bool isSingle, bool withLabels)
{
  freespace::ContourArrays arrays;
  vtkNew<vtkPoints> outputPoints;
  outputPoints->SetDataType(isSingle ? VTK_FLOAT : VTK_DOUBLE);
  outputPoints->SetNumberOfPoints(static_cast<vtkIdType>(size.points));
  output->SetPoints(outputPoints);
  void* coordinates = outputPoints->GetVoidPointer(0);
  (isSingle ? reinterpret_cast<void*&>(arrays.singlePoints)
            : reinterpret_cast<void*&>(arrays.doublePoints)) = coordinates;

  const vtkIdType n = static_cast<vtkIdType>(size.triangles);
  corners->SetNumberOfValues(3 * n);
  arrays.triangles = corners->GetPointer(0);
  if (withLabels)
  {
    vtkNew<vtkIntArray> view;
    view->SetName("View");
    view->SetNumberOfValues(n);
    vtkNew<vtkUnsignedCharArray> kind;
    kind->SetName("Kind");
    kind->SetNumberOfValues(n);
    output->GetCellData()->AddArray(view);
    output->GetCellData()->AddArray(kind);
    arrays.view = view->GetPointer(0);
    static_assert(sizeof(freespace::SurfaceKind) == 1, "a Kind is an unsigned char");
    arrays.kind = reinterpret_cast<freespace::SurfaceKind*>(kind->GetPointer(0));
  }
  return arrays;
}

/// Marks the points that belong to other pieces.
void MarkForeignPoints(vtkPolyData* output, const freespace::ContourSize& size)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(static_cast<vtkIdType>(size.points));
  for (std::size_t i = 0; i < size.points; ++i)
  {
    ghosts->SetValue(
      static_cast<vtkIdType>(i), i < size.ownPoints ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
  }
  output->GetPointData()->AddArray(ghosts);
}

/// Converts the corners to cells. Their further arrays are allocated last, when the core has released its
/// memory.
void SetTriangles(vtkPolyData* output, vtkTypeInt32Array* corners)
{
  const vtkIdType n = corners->GetNumberOfValues() / 3;
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(n + 1);
  for (vtkIdType t = 0; t <= n; ++t)
  {
    offsets->SetValue(t, static_cast<vtkTypeInt32>(3 * t));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  output->SetPolys(cells);
}

/// The lattice, as field data.
void TellLattice(vtkPolyData* output, const freespace::FreespaceUnion& core, int cells)
{
  const freespace::RegionOfInterest& region = core.FeatureRegion();
  vtkNew<vtkDoubleArray> lattice;
  lattice->SetName("Lattice");
  for (const double value : { static_cast<double>(cells), static_cast<double>(region.features),
         static_cast<double>(region.beyond) })
  {
    lattice->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(lattice);
}

/// Marks the triangles that are close to a feature: within slightly more than half the distance of features,
/// and within two cells.
void MarkSupported(vtkPolyData* output, const freespace::FreespaceUnion& core, double cell)
{
  const double reach = std::min(2 * cell, 0.6 * core.CellSide());
  const freespace::FeatureGrid grid(core.Features(), reach);
  vtkNew<vtkUnsignedCharArray> supported;
  supported->SetName(freespace::SupportedName);
  supported->SetNumberOfValues(output->GetNumberOfPolys());
  freespace::SMPParallelFor(static_cast<std::size_t>(output->GetNumberOfPolys()),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const vtkIdType id = static_cast<vtkIdType>(t);
        vtkNew<vtkIdList> corners;
        output->GetPolys()->GetCellAtId(id, corners);
        Eigen::Vector3d middle = Eigen::Vector3d::Zero(), corner;
        for (vtkIdType i = 0; i < 3; ++i)
        {
          output->GetPoints()->GetPoint(corners->GetId(i), corner.data());
          middle += corner / 3;
        }
        supported->SetValue(id, grid.IsNear(middle) ? 1 : 0);
      }
    });
  output->GetCellData()->AddArray(supported);
}

}

vtkBisectionContourFilter::vtkBisectionContourFilter()
  : Last(new Memory)
{
  this->SetNumberOfInputPorts(0);
  this->SetCellsToAutomatic();
  const freespace::ContourOptions contour;
  this->Tolerance = contour.tolerance;
  this->Clearance = contour.clearance;
  this->ExactCrossings = contour.exact;
  this->SharpEdges = contour.sharp;
  this->SharpAngle = contour.sharpAngle;
  this->MemoryLimit = contour.memoryLimit;
  const freespace::TriangleSelection selection;
  this->Crumbs = selection.crumbs;
  this->ObservedOnly = selection.observedOnly;
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

int vtkBisectionContourFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

/// The field to be contoured, and the options.
struct vtkBisectionContourFilter::Task
{
  std::shared_ptr<const freespace::FreespaceUnion> core;
  std::unique_ptr<FunctionField> function;
  bool isDirect = false; ///< the union itself; a transformed one is contoured like any function
  Eigen::AlignedBox3d bounds;
  freespace::ContourOptions options;

  const freespace::ContourField& Field() const
  {
    return this->isDirect ? static_cast<const freespace::ContourField&>(*this->core)
                          : *this->function;
  }
};

/// Returns false, with an error, if there is nothing to contour.
bool vtkBisectionContourFilter::Prepare(Task& task, const freespace::Progress& progress)
{
  if (!this->ImplicitFunction)
  {
    vtkErrorMacro("There is no implicit function to contour.");
    return false;
  }
  task.options.cells = this->Cells;
  task.options.tolerance = this->Tolerance;
  task.options.clearance = this->Clearance;
  task.options.exact = this->ExactCrossings != 0;
  task.options.sharp = this->SharpEdges != 0;
  task.options.sharpAngle = this->SharpAngle;
  task.options.memoryLimit = this->MemoryLimit;
  task.bounds = freespace::BoxOf(this->Bounds);
  task.function = std::make_unique<FunctionField>(this->ImplicitFunction);
  auto* freespaceUnion = vtkFreespaceUnion::SafeDownCast(this->ImplicitFunction);
  if (freespaceUnion)
  {
    task.core = freespaceUnion->GetCore(progress);
    if (!task.core)
    {
      vtkErrorMacro("The free space union has no valid disparity maps.");
      return false;
    }
    if (IsMereHull(*task.core))
    {
      vtkErrorMacro("None of the " << task.core->NumberOfViews()
                                   << " maps of the free space union has a usable triangle: "
                                      "features must be triangulated first.");
      return false;
    }
  }
  task.isDirect = task.core && !freespaceUnion->GetTransform();
  if (task.bounds.isEmpty() && !task.isDirect)
  {
    vtkErrorMacro("The function does not tell its bounds: set Bounds.");
    return false;
  }
  if (task.bounds.isEmpty())
  {
    task.bounds = task.core->Hull().Bounds();
  }
  this->ChooseCells(task, progress);
  return true;
}

void vtkBisectionContourFilter::ChooseCells(Task& task, const freespace::Progress& progress)
{
  if (this->Cells == -1)
  {
    task.options.cells =
      task.core ? task.core->Cells() : freespace::ResolutionOptions().fewestCells;
    task.options.cells =
      freespace::CellsWithinMemory(task.Field(), task.bounds, task.options, progress);
  }
}

int vtkBisectionContourFilter::FindCells()
{
  this->AbortExecute = 0;
  try
  {
    Task task;
    return this->Prepare(task, freespace::AlgorithmProgress(this)) ? task.options.cells : 0;
  }
  catch (const freespace::Aborted&)
  {
    return 0;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

// Of the progress, as of the time: building takes it for each triangle of the maps, contouring for each
// cell that the surface passes. A union that is up to date takes none.
double vtkBisectionContourFilter::ShareOfBuilding()
{
  constexpr double trianglesPerCell = 25.0; // take the same time
  constexpr double unknown = 0.3;
  auto* freespaceUnion = vtkFreespaceUnion::SafeDownCast(this->ImplicitFunction);
  if (!freespaceUnion || freespaceUnion->IsBuilt())
  {
    return 0.0;
  }
  vtkMultiBlockDataSet* maps = freespaceUnion->GetMaps();
  const double triangles = maps ? static_cast<double>(maps->GetNumberOfCells()) : 0.0;
  const double along =
    this->Cells > 0 ? this->Cells : freespace::ResolutionOptions().fewestCells; // or more
  const double cells = trianglesPerCell * along * along;
  return maps ? std::clamp(triangles / (triangles + cells), 0.01, 0.9) : unknown;
}

double vtkBisectionContourFilter::EstimateMemory()
{
  const freespace::Progress progress = freespace::AlgorithmProgress(this);
  const double built = this->ShareOfBuilding();
  this->AbortExecute = 0;
  try
  {
    Task task;
    if (!this->Prepare(task, progress.Part(0.0, built)))
    {
      return 0.0;
    }
    return freespace::EstimateContour(
      task.Field(), task.bounds, task.options, progress.Part(built, 1.0))
      .megabytes;
  }
  catch (const freespace::Aborted&)
  {
    return 0.0;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0.0;
  }
}

template <typename Allocate>
void vtkBisectionContourFilter::Contour(
  const Task& task, const Allocate& allocate, const freespace::Progress& progress)
{
  Memory last = std::move(*this->Last); // which is lost with an exception
  *this->Last = {};
  if (!this->Incremental || !task.isDirect || task.options.pieces > 1)
  {
    last = {};
    freespace::BisectionContour(
      task.Field(), task.bounds, task.options, allocate, progress, freespace::SMPParallelFor);
    return;
  }
  std::unique_ptr<freespace::UnionChange> change;
  if (last.Union)
  {
    change = std::make_unique<freespace::UnionChange>(last.Union, task.core);
  }
  freespace::BisectionContour(task.Field(), task.bounds, task.options, allocate, last.Contour,
    change.get(), progress, freespace::SMPParallelFor);
  *this->Last = { std::move(last.Contour), task.core };
}

int vtkBisectionContourFilter::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkInformation* information = outputVector->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(information);
  const freespace::Progress progress = freespace::AlgorithmProgress(this);
  const double built = this->ShareOfBuilding();
  try
  {
    freespace::RefuseGhosts(information);
    Task task;
    if (!this->Prepare(task, progress.Part(0.0, built)))
    {
      return freespace::AfterError(this);
    }
    if (information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()))
    {
      task.options.piece =
        information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
      task.options.pieces =
        information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    }
    const bool isSingle = freespace::SinglePrecisionSuffices(task.bounds, task.options);
    vtkNew<vtkTypeInt32Array> corners;
    const auto allocate = [&](const freespace::ContourSize& size)
    {
      if (task.options.pieces > 1)
      {
        MarkForeignPoints(output, size);
      }
      return AllocateOutput(output, corners, size, isSingle, task.isDirect);
    };
    this->Contour(task, allocate, progress.Part(built, 1.0));
    SetTriangles(output, corners);
    if (task.isDirect)
    {
      MarkSupported(output, *task.core, task.bounds.sizes().maxCoeff() / task.options.cells);
      TellLattice(output, *task.core, task.options.cells);
    }
    this->CrumbTriangles = 0;
    if (task.isDirect && !this->Crumbs && task.options.pieces == 1)
    {
      this->CrumbTriangles = freespace::DropCrumbs(output);
    }
    if (this->ObservedOnly && task.isDirect)
    {
      freespace::KeepObserved(output);
    }
    if (this->ComputeNormals)
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
  os << indent << "Incremental: " << this->Incremental << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Clearance: " << this->Clearance << "\n";
  os << indent << "ExactCrossings: " << this->ExactCrossings << "\n";
  os << indent << "SharpEdges: " << this->SharpEdges << "\n";
  os << indent << "SharpAngle: " << this->SharpAngle << "\n";
  os << indent << "Crumbs: " << this->Crumbs << "\n";
  os << indent << "CrumbTriangles: " << this->CrumbTriangles << "\n";
  os << indent << "ObservedOnly: " << this->ObservedOnly << "\n";
  os << indent << "ComputeNormals: " << this->ComputeNormals << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
