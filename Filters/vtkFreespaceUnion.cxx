// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceUnion.h"

#include "FreespaceQueries.h"
#include "SMPParallelFor.h"
#include "ViewBlocks.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkDoubleArray.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

vtkStandardNewMacro(vtkFreespaceUnion);

struct vtkFreespaceUnion::Internals
{
  vtkSmartPointer<vtkMultiBlockDataSet> Maps;
  vtkSmartPointer<vtkAlgorithmOutput> Connection;
  std::shared_ptr<const freespace::FreespaceUnion> Core;
  vtkMTimeType BuildTime = 0; ///< MTime that Core was built for
  std::mutex Building;
  /// The own MTime that Core was built for: what evaluations look at, which come by the million.
  std::atomic<vtkMTimeType> OwnBuildTime{ 0 };
};

namespace
{

Eigen::Vector3d PointOf(vtkPoints* points, std::size_t i)
{
  Eigen::Vector3d point;
  points->GetPoint(static_cast<vtkIdType>(i), point.data());
  return point;
}

}

vtkFreespaceUnion::vtkFreespaceUnion()
  : Inner(new Internals)
{
}

vtkFreespaceUnion::~vtkFreespaceUnion() = default;

void vtkFreespaceUnion::SetMaps(vtkMultiBlockDataSet* maps)
{
  if (this->Inner->Maps != maps || this->Inner->Connection)
  {
    this->Inner->Maps = maps;
    this->Inner->Connection = nullptr;
    this->Modified();
  }
}

vtkMultiBlockDataSet* vtkFreespaceUnion::GetMaps()
{
  return this->Inner->Maps;
}

void vtkFreespaceUnion::SetInputConnection(vtkAlgorithmOutput* output)
{
  if (this->Inner->Connection != output)
  {
    this->Inner->Connection = output;
    this->Inner->Maps = nullptr;
    this->Modified();
  }
}

vtkMTimeType vtkFreespaceUnion::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Inner->Connection)
  {
    vtkAlgorithm* producer = this->Inner->Connection->GetProducer();
    time = std::max(time, producer->GetMTime());
    if (auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(producer->GetExecutive()))
    {
      pipeline->UpdatePipelineMTime();
      time = std::max(time, pipeline->GetPipelineMTime());
    }
  }
  else if (vtkMultiBlockDataSet* maps = this->Inner->Maps)
  {
    time = std::max(time, maps->GetMTime());
    for (unsigned int i = 0; i < maps->GetNumberOfBlocks(); ++i)
    {
      vtkDataObject* block = maps->GetBlock(i);
      time = block ? std::max(time, block->GetMTime()) : time;
    }
  }
  return time;
}

void vtkFreespaceUnion::Update()
{
  const vtkMTimeType time = this->GetMTime();
  const std::lock_guard<std::mutex> lock(this->Inner->Building);
  if (this->Inner->BuildTime != time)
  {
    this->Build();
    this->Inner->BuildTime = time;
    this->Inner->OwnBuildTime = this->Superclass::GetMTime();
  }
}

void vtkFreespaceUnion::Build()
{
  this->Inner->Core.reset();
  if (this->Inner->Connection)
  {
    vtkAlgorithm* producer = this->Inner->Connection->GetProducer();
    const int port = this->Inner->Connection->GetIndex();
    producer->Update(port);
    this->Inner->Maps = vtkMultiBlockDataSet::SafeDownCast(producer->GetOutputDataObject(port));
  }
  if (!this->Inner->Maps)
  {
    vtkErrorMacro("There are no disparity maps.");
    return;
  }
  freespace::FreespaceUnionOptions options;
  options.minimumViews = this->MinimumViews;
  options.hullMargin = this->HullMargin;
  try
  {
    vtkMultiBlockDataSet* maps = this->Inner->Maps;
    this->Inner->Core = std::make_shared<freespace::FreespaceUnion>(
      maps->GetNumberOfBlocks(),
      [maps](std::size_t i)
      { return freespace::MapFromBlocks(maps, static_cast<unsigned int>(i)); },
      options, freespace::SMPParallelFor);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

const freespace::FreespaceUnion* vtkFreespaceUnion::Built()
{
  if (this->Inner->OwnBuildTime != this->Superclass::GetMTime())
  {
    this->Update();
  }
  return this->Inner->Core.get();
}

std::shared_ptr<const freespace::FreespaceUnion> vtkFreespaceUnion::GetCore()
{
  this->Update();
  return this->Inner->Core;
}

bool vtkFreespaceUnion::IsValid()
{
  return this->GetCore() != nullptr;
}

double vtkFreespaceUnion::EvaluateFunction(double x[3])
{
  const freespace::FreespaceUnion* core = this->Built();
  const double value = core ? core->Value(Eigen::Vector3d(x)) : HUGE_VAL;
  return std::min(value, VTK_DOUBLE_MAX);
}

void vtkFreespaceUnion::EvaluateGradient(double x[3], double g[3])
{
  const freespace::FreespaceUnion* core = this->Built();
  Eigen::Map<Eigen::Vector3d> gradient(g);
  gradient = Eigen::Vector3d::Zero();
  if (core)
  {
    gradient = core->Gradient(Eigen::Vector3d(x));
  }
}

bool vtkFreespaceUnion::IsPointFree(const double point[3])
{
  const auto core = this->GetCore();
  return !core || core->IsFree(Eigen::Vector3d(point));
}

double vtkFreespaceUnion::FirstBlocked(const double first[3], const double last[3])
{
  const auto core = this->GetCore();
  return core ? freespace::FirstBlocked(*core, Eigen::Vector3d(first), Eigen::Vector3d(last))
              : HUGE_VAL;
}

bool vtkFreespaceUnion::IsSegmentFree(const double first[3], const double last[3])
{
  return this->FirstBlocked(first, last) > 1.0;
}

bool vtkFreespaceUnion::IsSphereFree(const double center[3], double radius)
{
  const auto core = this->GetCore();
  return !core || freespace::IsSphereFree(*core, Eigen::Vector3d(center), radius);
}

bool vtkFreespaceUnion::IsBoxFree(const double bounds[6])
{
  const auto core = this->GetCore();
  const Eigen::AlignedBox3d box(Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]));
  return !core || freespace::IsBoxFree(*core, box);
}

bool vtkFreespaceUnion::HaveSameSize(vtkIdType size, vtkIdType otherSize)
{
  if (size != otherSize)
  {
    vtkErrorMacro("A batch has " << size << " and " << otherSize << " entries.");
  }
  return size == otherSize;
}

bool vtkFreespaceUnion::ArePointsFree(vtkPoints* points, vtkUnsignedCharArray* free)
{
  const auto core = this->GetCore();
  free->SetNumberOfComponents(1);
  free->SetNumberOfValues(points->GetNumberOfPoints());
  freespace::SMPParallelFor(points->GetNumberOfPoints(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        free->SetValue(i, !core || core->IsFree(PointOf(points, i)));
      }
    });
  return true;
}

bool vtkFreespaceUnion::FirstBlocked(vtkPoints* first, vtkPoints* last, vtkDoubleArray* fractions)
{
  if (!this->HaveSameSize(first->GetNumberOfPoints(), last->GetNumberOfPoints()))
  {
    return false;
  }
  const auto core = this->GetCore();
  fractions->SetNumberOfComponents(1);
  fractions->SetNumberOfValues(first->GetNumberOfPoints());
  freespace::SMPParallelFor(first->GetNumberOfPoints(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        fractions->SetValue(
          i, core ? freespace::FirstBlocked(*core, PointOf(first, i), PointOf(last, i)) : HUGE_VAL);
      }
    });
  return true;
}

bool vtkFreespaceUnion::AreSpheresFree(
  vtkPoints* centers, vtkDoubleArray* radii, vtkUnsignedCharArray* free)
{
  if (!this->HaveSameSize(centers->GetNumberOfPoints(), radii->GetNumberOfValues()))
  {
    return false;
  }
  const auto core = this->GetCore();
  free->SetNumberOfComponents(1);
  free->SetNumberOfValues(centers->GetNumberOfPoints());
  freespace::SMPParallelFor(centers->GetNumberOfPoints(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        free->SetValue(
          i, !core || freespace::IsSphereFree(*core, PointOf(centers, i), radii->GetValue(i)));
      }
    });
  return true;
}

void vtkFreespaceUnion::GetBounds(double bounds[6])
{
  const auto core = this->GetCore();
  vtkMath::UninitializeBounds(bounds);
  if (core && !core->Hull().IsEmpty())
  {
    const Eigen::AlignedBox3d& box = core->Hull().Bounds();
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = box.min()[axis];
      bounds[2 * axis + 1] = box.max()[axis];
    }
  }
}

void vtkFreespaceUnion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MinimumViews: " << this->MinimumViews << "\n";
  os << indent << "HullMargin: " << this->HullMargin << "\n";
  os << indent << "Maps: " << this->Inner->Maps.Get() << "\n";
  os << indent << "InputConnection: " << this->Inner->Connection.Get() << "\n";
}
