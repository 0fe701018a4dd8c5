// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceUnion.h"

#include "Common/ParallelForWithProgress.h"
#include "Common/Progress.h"
#include "Data/BlockMaps.h"
#include "Data/Boxes.h"
#include "Data/ViewEdits.h"
#include "Data/ViewInput.h"
#include "Execution/AskAll.h"
#include "Execution/SMPParallelFor.h"
#include "Execution/WatchedUpdate.h"
#include "Freespace/FreespaceQueries.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
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
  vtkSmartPointer<vtkAlgorithm> Producer; ///< which an output does not keep alive
  std::shared_ptr<const freespace::FreespaceUnion> Core;
  freespace::BlockMaps Kept;     ///< the structures of single maps, for the next building
  vtkMTimeType BuildTime = 0;    ///< MTime that Core was built for
  std::recursive_mutex Building; ///< recursive for observers that ask while it is built
  bool IsBuilding = false;
  /// The own MTime that Core was built for, which the millions of evaluations check.
  std::atomic<vtkMTimeType> OwnBuildTime{ 0 };
};

namespace
{

// The share of the maps, which may come from a pipeline, in building; the rest is the core.
constexpr double MapsShare = 0.5;

// The share of what is made of each map by itself.
constexpr double OwnShare = 0.8;

Eigen::Vector3d PointOf(vtkPoints* points, vtkIdType i)
{
  Eigen::Vector3d point;
  points->GetPoint(i, point.data());
  return point;
}

}

vtkFreespaceUnion::vtkFreespaceUnion()
  : Inner(new Internals)
{
  const freespace::FreespaceUnionOptions options;
  this->MinimumViews = options.minimumViews;
  this->HullMargin = options.hullMargin;
  this->Contradiction = options.contradiction;
}

vtkFreespaceUnion::~vtkFreespaceUnion() = default;

void vtkFreespaceUnion::SetMaps(vtkMultiBlockDataSet* maps)
{
  if (this->Inner->Maps != maps || this->Inner->Connection)
  {
    this->Inner->Maps = maps;
    this->Inner->Connection = nullptr;
    this->Inner->Producer = nullptr;
    if (!maps)
    {
      this->Inner->Kept.Clear();
    }
    this->Modified();
  }
}

void vtkFreespaceUnion::SetInputDataObject(vtkDataObject* maps)
{
  try
  {
    this->SetMaps(freespace::ViewsOf(maps));
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
    this->SetMaps(nullptr);
  }
}

vtkMultiBlockDataSet* vtkFreespaceUnion::GetMaps()
{
  return this->Inner->Maps;
}

// Changes the maps by a function of them, which throws Error where it cannot.
template <typename Change>
bool vtkFreespaceUnion::Edit(const Change& change)
{
  try
  {
    if (this->Inner->Connection)
    {
      throw freespace::Error("The maps come from a pipeline, which alone can change them.");
    }
    const vtkSmartPointer<vtkMultiBlockDataSet> maps = this->Inner->Maps;
    this->SetMaps(change(maps ? maps : vtkSmartPointer<vtkMultiBlockDataSet>::New()));
    return true;
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

bool vtkFreespaceUnion::AddView(const std::string& name, vtkPolyData* map, int sourceIndex)
{
  return this->Edit(
    [&](vtkMultiBlockDataSet* maps) { return freespace::WithView(maps, name, map, sourceIndex); });
}

bool vtkFreespaceUnion::RemoveView(const std::string& name)
{
  return this->Edit([&](vtkMultiBlockDataSet* maps)
    { return this->Inner->Kept.Remove(maps, freespace::FindView(maps, name)); });
}

bool vtkFreespaceUnion::RemoveView(int index)
{
  return this->Edit(
    [&](vtkMultiBlockDataSet* maps) { return this->Inner->Kept.Remove(maps, index); });
}

void vtkFreespaceUnion::SetInputConnection(vtkAlgorithmOutput* output)
{
  if (this->Inner->Connection != output)
  {
    this->Inner->Connection = output;
    this->Inner->Producer = output ? output->GetProducer() : nullptr;
    this->Inner->Maps = nullptr;
    this->Modified();
  }
}

vtkAlgorithmOutput* vtkFreespaceUnion::GetInputConnection()
{
  return this->Inner->Connection;
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
  this->GetCore();
}

// Tells the function's own observers, who can stop what is going on.
freespace::Progress vtkFreespaceUnion::OwnProgress()
{
  this->AbortExecute = 0;
  return freespace::Progress(
    [this](double fraction)
    {
      this->InvokeEvent(vtkCommand::ProgressEvent, &fraction);
      return this->AbortExecute == 0;
    });
}

void vtkFreespaceUnion::Build(const freespace::Progress& progress)
{
  this->Inner->Core.reset();
  freespace::Progress building = progress;
  if (this->Inner->Connection)
  {
    vtkAlgorithm* producer = this->Inner->Connection->GetProducer();
    const int port = this->Inner->Connection->GetIndex();
    const freespace::Progress updating = progress.Part(0.0, MapsShare);
    freespace::WatchedUpdate(producer, updating).Run(port);
    building = progress.Part(MapsShare, 1.0);
    this->Inner->Maps = freespace::ViewsOf(producer->GetOutputDataObject(port));
  }
  if (!this->Inner->Maps)
  {
    throw freespace::Error("There are no disparity maps.");
  }
  freespace::FreespaceUnionOptions options;
  options.minimumViews = this->MinimumViews;
  options.hullMargin = this->HullMargin;
  options.contradiction = this->Contradiction;
  using Mode = freespace::RegionOptions::Mode;
  options.region.mode = this->RegionMode == BOX_REGION ? Mode::Box
    : this->RegionMode == WHOLE_REGION                 ? Mode::All
                                                       : Mode::Automatic;
  options.region.box = freespace::BoxOf(this->Region);
  options.CheckFor(this->Inner->Maps->GetNumberOfBlocks());
  const freespace::SharedMaps& maps = this->Inner->Kept.Of(
    this->Inner->Maps, freespace::SMPParallelFor, building.Part(0.0, OwnShare));
  this->Inner->Core = std::make_shared<freespace::FreespaceUnion>(
    maps, options, freespace::SMPParallelFor, building.Part(OwnShare, 1.0));
}

bool vtkFreespaceUnion::IsBuilt()
{
  const vtkMTimeType time = this->GetMTime();
  const std::lock_guard<std::recursive_mutex> lock(this->Inner->Building);
  return this->Inner->BuildTime == time;
}

std::shared_ptr<const freespace::FreespaceUnion> vtkFreespaceUnion::GetCore(
  const freespace::Progress& progress)
{
  const vtkMTimeType time = this->GetMTime();
  const std::lock_guard<std::recursive_mutex> lock(this->Inner->Building);
  if (this->Inner->BuildTime == time || this->Inner->IsBuilding)
  {
    return this->Inner->Core;
  }
  this->Inner->IsBuilding = true;
  this->Inner->BuildTime = 0;
  this->Inner->OwnBuildTime = 0;
  try
  {
    this->Build(progress);
  }
  catch (const freespace::Aborted&)
  {
    this->Inner->IsBuilding = false;
    throw;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  this->Inner->IsBuilding = false;
  this->Inner->BuildTime = time;
  this->Inner->OwnBuildTime = this->Superclass::GetMTime();
  return this->Inner->Core;
}

std::shared_ptr<const freespace::FreespaceUnion> vtkFreespaceUnion::GetCore()
{
  try
  {
    return this->GetCore(this->IsBuilt() ? freespace::Progress() : this->OwnProgress());
  }
  catch (const freespace::Aborted&)
  {
    return nullptr;
  }
}

const freespace::FreespaceUnion* vtkFreespaceUnion::Built()
{
  if (this->Inner->OwnBuildTime != this->Superclass::GetMTime())
  {
    this->GetCore(freespace::Progress()); // which nobody stops
  }
  return this->Inner->Core.get();
}

bool vtkFreespaceUnion::IsValid()
{
  return this->GetCore() != nullptr;
}

double vtkFreespaceUnion::EvaluateFunction(double x[3])
{
  const freespace::FreespaceUnion* core = this->Built();
  const double value = core ? core->Value(Eigen::Vector3d(x)) : -HUGE_VAL;
  return std::clamp(value, -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
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
  return core && freespace::IsPointFree(*core, Eigen::Vector3d(point));
}

int vtkFreespaceUnion::GetPointState(const double point[3])
{
  const auto core = this->GetCore();
  return core ? static_cast<int>(freespace::StateOf(*core, Eigen::Vector3d(point))) : UNKNOWN;
}

double vtkFreespaceUnion::FirstBlocked(const double first[3], const double last[3])
{
  const auto core = this->GetCore();
  return core ? freespace::FirstBlocked(*core, Eigen::Vector3d(first), Eigen::Vector3d(last)) : 0.0;
}

bool vtkFreespaceUnion::IsSphereFree(const double center[3], double radius)
{
  const auto core = this->GetCore();
  return core && freespace::IsSphereFree(*core, Eigen::Vector3d(center), radius);
}

bool vtkFreespaceUnion::IsBoxFree(const double bounds[6])
{
  const auto core = this->GetCore();
  return core && freespace::IsBoxFree(*core, freespace::BoxOf(bounds));
}

bool vtkFreespaceUnion::AreThere(vtkObject* first, vtkObject* second)
{
  if (!first || !second)
  {
    vtkErrorMacro("A batch has no points or no array for the results.");
  }
  return first && second;
}

bool vtkFreespaceUnion::HaveSameSize(vtkIdType size, vtkIdType otherSize)
{
  if (size != otherSize)
  {
    vtkErrorMacro("A batch has " << size << " and " << otherSize << " entries.");
  }
  return size == otherSize;
}

bool vtkFreespaceUnion::GetPointStates(vtkPoints* points, vtkUnsignedCharArray* states)
{
  if (!this->AreThere(points, states))
  {
    return false;
  }
  return freespace::AskAll(this, this->OwnProgress(), &freespace::FreespaceUnion::IndexForPoints,
    points->GetNumberOfPoints(), states,
    [&](const freespace::FreespaceUnion* core, vtkIdType i)
    {
      states->SetValue(i,
        core ? static_cast<unsigned char>(freespace::StateOf(*core, PointOf(points, i)))
             : static_cast<unsigned char>(UNKNOWN));
    });
}

bool vtkFreespaceUnion::ArePointsFree(vtkPoints* points, vtkUnsignedCharArray* free)
{
  if (!this->AreThere(points, free))
  {
    return false;
  }
  return freespace::AskAll(this, this->OwnProgress(), &freespace::FreespaceUnion::IndexForPoints,
    points->GetNumberOfPoints(), free,
    [&](const freespace::FreespaceUnion* core, vtkIdType i)
    { free->SetValue(i, core && freespace::IsPointFree(*core, PointOf(points, i))); });
}

bool vtkFreespaceUnion::FirstBlocked(vtkPoints* first, vtkPoints* last, vtkDoubleArray* fractions)
{
  if (!this->AreThere(first, last) || !this->AreThere(first, fractions) ||
    !this->HaveSameSize(first->GetNumberOfPoints(), last->GetNumberOfPoints()))
  {
    return false;
  }
  return freespace::AskAll(this, this->OwnProgress(), &freespace::FreespaceUnion::IndexForBoxes,
    first->GetNumberOfPoints(), fractions,
    [&](const freespace::FreespaceUnion* core, vtkIdType i)
    {
      fractions->SetValue(
        i, core ? freespace::FirstBlocked(*core, PointOf(first, i), PointOf(last, i)) : 0.0);
    });
}

bool vtkFreespaceUnion::AreSpheresFree(
  vtkPoints* centers, vtkDoubleArray* radii, vtkUnsignedCharArray* free)
{
  if (!this->AreThere(centers, radii) || !this->AreThere(centers, free) ||
    !this->HaveSameSize(centers->GetNumberOfPoints(), radii->GetNumberOfValues()))
  {
    return false;
  }
  return freespace::AskAll(this, this->OwnProgress(), &freespace::FreespaceUnion::IndexForBoxes,
    centers->GetNumberOfPoints(), free,
    [&](const freespace::FreespaceUnion* core, vtkIdType i)
    {
      free->SetValue(
        i, core && freespace::IsSphereFree(*core, PointOf(centers, i), radii->GetValue(i)));
    });
}

void vtkFreespaceUnion::GetBounds(double bounds[6])
{
  const auto core = this->GetCore();
  freespace::GiveBounds(core ? core->Hull().Bounds() : Eigen::AlignedBox3d(), bounds);
}

void vtkFreespaceUnion::SetRegion(double x0, double x1, double y0, double y1, double z0, double z1)
{
  const double bounds[6] = { x0, x1, y0, y1, z0, z1 };
  this->SetRegion(bounds);
}

void vtkFreespaceUnion::SetRegion(const double bounds[6])
{
  if (this->RegionMode != BOX_REGION || !std::equal(bounds, bounds + 6, this->Region))
  {
    std::copy(bounds, bounds + 6, this->Region);
    this->RegionMode = BOX_REGION;
    this->Modified();
  }
}

void vtkFreespaceUnion::GetRegionBounds(double bounds[6])
{
  const auto core = this->GetCore();
  freespace::GiveBounds(core ? core->FeatureRegion().box : Eigen::AlignedBox3d(), bounds);
}

vtkIdType vtkFreespaceUnion::GetNumberOfFeatures()
{
  const auto core = this->GetCore();
  return core ? static_cast<vtkIdType>(core->FeatureRegion().features) : 0;
}

vtkIdType vtkFreespaceUnion::GetNumberOfFeaturesBeyond()
{
  const auto core = this->GetCore();
  return core ? static_cast<vtkIdType>(core->FeatureRegion().beyond) : 0;
}

int vtkFreespaceUnion::FindMinimumViews()
{
  const auto core = this->GetCore();
  return core ? core->Rule().enough : 0;
}

int vtkFreespaceUnion::GetSuggestedCells()
{
  const auto core = this->GetCore();
  return core ? core->Cells() : 0;
}

void vtkFreespaceUnion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MinimumViews: " << this->MinimumViews << "\n";
  os << indent << "HullMargin: " << this->HullMargin << "\n";
  os << indent << "Contradiction: " << this->Contradiction << "\n";
  os << indent << "RegionMode: " << this->RegionMode << "\n";
  os << indent << "Region:";
  for (double bound : this->Region)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "AbortExecute: " << this->AbortExecute << "\n";
  os << indent << "Maps: " << this->Inner->Maps.Get() << "\n";
  os << indent << "InputConnection: " << this->Inner->Connection.Get() << "\n";
}
