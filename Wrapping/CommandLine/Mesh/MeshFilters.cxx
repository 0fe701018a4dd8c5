// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshFilters.h"

#include "Common/Error.h"
#include "Execution/Sequentially.h"
#include "Mesh/MeshValues.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkClipPolyData.h>
#include <vtkFieldData.h>
#include <vtkFillHolesFilter.h>
#include <vtkIdTypeArray.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPhotographReader.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkPolyDataNormals.h>
#include <vtkQuadricDecimation.h>
#include <vtkReverseSense.h>
#include <vtkSimplifySurfaceFilter.h>
#include <vtkStaticPointLocator.h>
#include <vtkTextureBaker.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangle.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freespace
{

namespace
{

using Surface = vtkSmartPointer<vtkPolyData>;

Surface Run(
  Session& session, vtkPolyDataAlgorithm* filter, const std::string& stage, vtkPolyData* surface)
{
  filter->SetInputDataObject(surface);
  session.Run(filter, stage);
  return filter->GetOutput();
}

Surface RunSequentially(
  Session& session, vtkPolyDataAlgorithm* filter, const std::string& stage, vtkPolyData* surface)
{
  Surface result;
  freespace::Sequentially([&] { result = Run(session, filter, stage, surface); });
  return result;
}

double NumberOf(const std::string& text)
{
  return NumbersOf(text).at(0);
}

// The areas of the regions by their numbers in the filter's output.
std::vector<double> AreasOf(vtkPolyData* colored, int regions)
{
  std::vector<double> areas(regions, 0);
  vtkDataArray* ids = colored->GetPointData()->GetArray("RegionId");
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType i = 0; i < colored->GetNumberOfPolys(); ++i)
  {
    colored->GetPolys()->GetCellAtId(i, size, corners);
    double p[3][3];
    for (int k = 0; k < 3; ++k)
    {
      colored->GetPoint(corners[k], p[k]);
    }
    areas.at(static_cast<std::size_t>(ids->GetTuple1(corners[0]))) +=
      vtkTriangle::TriangleArea(p[0], p[1], p[2]);
  }
  return areas;
}

Surface KeepRegions(Session& session, vtkPolyDataConnectivityFilter* filter,
  const std::vector<int>& regions, const std::string& stage)
{
  filter->ColorRegionsOff();
  filter->SetExtractionModeToSpecifiedRegions();
  for (int region : regions)
  {
    filter->AddSpecifiedRegion(region);
  }
  session.Run(filter, stage);
  vtkNew<vtkCleanPolyData> clean; // the filter keeps points that no triangle has any more
  clean->PointMergingOff();
  return Run(session, clean, stage, filter->GetOutput());
}

Surface Transformed(
  Session& session, vtkTransform* transform, const std::string& stage, vtkPolyData* surface)
{
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  Surface moved = Run(session, filter, stage, surface);
  moved->GetFieldData()->Initialize(); // a viewpoint stands where the surface was
  if (transform->GetMatrix()->Determinant() < 0)
  {
    vtkNew<vtkReverseSense> reverse; // what was outside of it stays so
    reverse->ReverseCellsOn();
    moved = Run(session, reverse, stage, moved);
  }
  return moved;
}

// Limits the displacement of points to a length.
void LimitMoves(vtkPolyData* before, vtkPolyData* after, double length)
{
  for (vtkIdType i = 0; i < after->GetNumberOfPoints(); ++i)
  {
    double from[3], to[3];
    before->GetPoint(i, from);
    after->GetPoint(i, to);
    const double moved = std::sqrt(vtkMath::Distance2BetweenPoints(from, to));
    for (int axis = 0; axis < 3 && moved > length; ++axis)
    {
      to[axis] = from[axis] + (to[axis] - from[axis]) * (length / moved);
    }
    after->GetPoints()->SetPoint(i, to);
  }
}

}

Surface Crop(Session& session, const std::string& box, vtkPolyData* surface)
{
  const std::vector<double> bounds = NumbersOf(box);
  Surface cropped = surface;
  for (int side = 0; side < 6 && cropped->GetNumberOfCells() > 0; ++side)
  {
    double origin[3] = {}, normal[3] = {};
    origin[side / 2] = bounds[side];
    normal[side / 2] = side % 2 == 0 ? 1 : -1;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(origin);
    plane->SetNormal(normal);
    vtkNew<vtkClipPolyData> clip;
    clip->SetClipFunction(plane);
    clip->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    cropped = Run(session, clip, "crop", cropped);
  }
  vtkNew<vtkTriangleFilter> triangles;
  return Run(session, triangles, "crop", cropped);
}

Surface KeepLargest(Session& session, const std::string& count, vtkPolyData* surface)
{
  vtkNew<vtkPolyDataConnectivityFilter> filter;
  filter->SetExtractionModeToAllRegions();
  Run(session, filter, "largest", surface);
  std::vector<int> regions(filter->GetNumberOfExtractedRegions());
  std::iota(regions.begin(), regions.end(), 0);
  vtkIdTypeArray* sizes = filter->GetRegionSizes();
  std::stable_sort(regions.begin(), regions.end(),
    [sizes](int one, int other) { return sizes->GetValue(one) > sizes->GetValue(other); });
  regions.resize(std::min(regions.size(), static_cast<std::size_t>(NumberOf(count))));
  return KeepRegions(session, filter, regions, "largest");
}

Surface DropCrumbs(Session& session, const std::string& area, vtkPolyData* surface)
{
  vtkNew<vtkPolyDataConnectivityFilter> filter;
  filter->SetExtractionModeToAllRegions();
  filter->ColorRegionsOn();
  const Surface colored = Run(session, filter, "crumbs", surface);
  const std::vector<double> areas = AreasOf(colored, filter->GetNumberOfExtractedRegions());
  std::vector<int> regions;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    if (areas[i] >= NumberOf(area))
    {
      regions.push_back(static_cast<int>(i));
    }
  }
  return KeepRegions(session, filter, regions, "crumbs");
}

Surface Smooth(Session& session, const std::string& length, vtkPolyData* surface)
{
  vtkNew<vtkWindowedSincPolyDataFilter> filter;
  filter->NormalizeCoordinatesOn();
  filter->FeatureEdgeSmoothingOn(); // of 45 degrees: their vertices move along them
  filter->BoundarySmoothingOff();
  Surface smooth = RunSequentially(session, filter, "smooth", surface);
  LimitMoves(surface, smooth, NumberOf(length));
  return smooth;
}

Surface Simplify(Session& session, const std::string& length, vtkPolyData* surface)
{
  vtkNew<vtkSimplifySurfaceFilter> filter;
  filter->SetDistance(NumberOf(length));
  return Run(session, filter, "simplify", surface);
}

Surface Decimate(Session& session, const std::string& count, vtkPolyData* surface)
{
  const double target = NumberOf(count);
  if (target >= surface->GetNumberOfPolys())
  {
    return surface;
  }
  vtkNew<vtkQuadricDecimation> filter;
  filter->SetTargetReduction(1 - target / surface->GetNumberOfPolys());
  return Run(session, filter, "triangles", surface);
}

Surface Fill(Session& session, const std::string& size, vtkPolyData* surface)
{
  vtkNew<vtkFillHolesFilter> filter;
  filter->SetHoleSize(NumberOf(size));
  const Surface filled = Run(session, filter, "fill", surface);
  vtkNew<vtkPolyDataNormals> orient; // VTK turns the new triangles either way
  orient->SplittingOff();
  orient->ConsistencyOn();
  orient->ComputePointNormalsOff();
  orient->ComputeCellNormalsOn(); // without any normals the filter does nothing
  Surface oriented = RunSequentially(session, orient, "fill", filled);
  oriented->GetCellData()->RemoveArray("Normals");
  return oriented;
}

Surface Transform(Session& session, const std::string& fileName, vtkPolyData* surface)
{
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(ReadMatrix(fileName).data());
  return Transformed(session, transform, "transform", surface);
}

Surface Scale(Session& session, const std::string& factor, vtkPolyData* surface)
{
  vtkNew<vtkTransform> transform;
  transform->Scale(NumberOf(factor), NumberOf(factor), NumberOf(factor));
  return Transformed(session, transform, "scale", surface);
}

Surface Shift(Session& session, const std::string& vector, vtkPolyData* surface)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(NumbersOf(vector).data());
  return Transformed(session, transform, "shift", surface);
}

Surface AddNormals(Session& session, const std::string&, vtkPolyData* surface)
{
  vtkNew<vtkPolyDataNormals> filter;
  filter->SplittingOff();
  filter->ConsistencyOn();
  return RunSequentially(session, filter, "normals", surface);
}

Surface ColorFromScene(Session& session, const std::string& scene, vtkPolyData* surface)
{
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(scene);
  session.Run(photographs, "images");
  vtkNew<vtkTextureBaker> baker;
  baker->SetPhotographs(photographs->GetOutput());
  const Surface charts = Run(session, baker, "colour", surface);
  auto* found = vtkUnsignedCharArray::SafeDownCast(charts->GetPointData()->GetArray("RGB"));
  if (!found)
  {
    throw Error("No image of " + scene + " sees the surface: it is of another place.");
  }
  // The charts duplicate points, at the positions of the surface's.
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(charts);
  locator->BuildLocator();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    colors->SetTuple(i, locator->FindClosestPoint(surface->GetPoint(i)), found);
  }
  auto colored = Surface::New();
  colored->ShallowCopy(surface);
  colored->GetPointData()->SetScalars(colors);
  return colored;
}

}
