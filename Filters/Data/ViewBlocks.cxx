// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewBlocks.h"

#include "Common/CameraFault.h"
#include "Common/Error.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <climits>
#include <cmath>

namespace freespace
{

namespace
{

using RowMajor3x3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor3x4 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

void AddFieldArray(vtkDataObject* block, const char* name, const double* values, int count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->InsertNextTypedTuple(values);
  block->GetFieldData()->AddArray(array);
}

[[noreturn]] void ThrowNoArray(const std::string& block, const char* name, const std::string& shape)
{
  throw Error("View '" + block + "' has no array " + name + " of " + shape + ".");
}

// An array of the field data with this number of values.
vtkDataArray* FieldArray(vtkFieldData* data, const char* name, int values, const std::string& block)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array || array->GetNumberOfComponents() * array->GetNumberOfTuples() != values)
  {
    ThrowNoArray(block, name, std::to_string(values) + " values");
  }
  return array;
}

vtkDataArray* PointArray(
  vtkPolyData* data, const char* name, int components, const std::string& block)
{
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  const vtkIdType points = data->GetNumberOfPoints();
  if (!array || array->GetNumberOfComponents() != components ||
    array->GetNumberOfTuples() != points)
  {
    ThrowNoArray(block, name,
      std::to_string(points) + " tuples of " + std::to_string(components) + " components");
  }
  return array;
}

// A number that comes as a double, where an array is of such.
int IntFrom(double value, const std::string& block)
{
  if (!(std::abs(value) <= INT_MAX))
  {
    throw Error(
      "View '" + block + "' has a number that is not finite or too large for what it counts.");
  }
  return static_cast<int>(value);
}

// Single-row arrays come as one tuple or as many tuples of one component, after a round trip.
double FlatValue(vtkDataArray* array, int index)
{
  const int components = array->GetNumberOfComponents();
  return array->GetComponent(index / components, index % components);
}

}

void AddCamera(vtkDataObject* block, const Camera& camera, const std::string& imageFile)
{
  const RowMajor3x3 intrinsics = camera.K;
  RowMajor3x4 camFromWorld;
  camFromWorld << camera.R, camera.t;
  AddFieldArray(block, "CameraIntrinsics", intrinsics.data(), 9);
  AddFieldArray(block, "CameraFromWorld", camFromWorld.data(), 12);

  vtkNew<vtkIntArray> size;
  size->SetName("ImageSize");
  size->SetNumberOfComponents(2);
  const int values[2] = { camera.width, camera.height };
  size->InsertNextTypedTuple(values);
  block->GetFieldData()->AddArray(size);

  vtkNew<vtkStringArray> file;
  file->SetName("ImageFile");
  file->InsertNextValue(imageFile);
  block->GetFieldData()->AddArray(file);
}

Camera CameraFromBlock(vtkDataObject* block, const std::string& name)
{
  vtkFieldData* field = block->GetFieldData();
  vtkDataArray* intrinsics = FieldArray(field, "CameraIntrinsics", 9, name);
  vtkDataArray* camFromWorld = FieldArray(field, "CameraFromWorld", 12, name);
  vtkDataArray* size = FieldArray(field, "ImageSize", 2, name);
  Camera camera;
  for (int i = 0; i < 9; ++i)
  {
    camera.K(i / 3, i % 3) = FlatValue(intrinsics, i);
  }
  for (int i = 0; i < 12; ++i)
  {
    (i % 4 < 3 ? camera.R(i / 4, i % 4) : camera.t(i / 4)) = FlatValue(camFromWorld, i);
  }
  camera.width = IntFrom(FlatValue(size, 0), name);
  camera.height = IntFrom(FlatValue(size, 1), name);
  if (const std::string fault = CameraFault(camera); !fault.empty())
  {
    throw Error("View '" + name + "' " + fault + ".");
  }
  return camera;
}

namespace
{

template <typename Array, typename Value, typename SetTuple>
void AddPointArray(vtkPolyData* block, const char* name, int components,
  const std::vector<Value>& values, SetTuple&& setTuple)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    setTuple(array, static_cast<vtkIdType>(i), values[i]);
  }
  block->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> BlockWithPoints(const View& view)
{
  auto block = vtkSmartPointer<vtkPolyData>::New();
  const vtkIdType count = static_cast<vtkIdType>(view.points.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkDoubleArray> imagePoints;
  imagePoints->SetName("ImagePoint");
  imagePoints->SetNumberOfComponents(2);
  imagePoints->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, view.points[i].data());
    imagePoints->SetTypedTuple(i, view.imagePoints[i].data());
  }
  block->SetPoints(points);
  block->GetPointData()->AddArray(imagePoints);
  if (!view.deviations.empty())
  {
    AddPointArray<vtkDoubleArray>(block, "DisparityDeviation", 1, view.deviations,
      [](vtkDoubleArray* array, vtkIdType i, double deviation) { array->SetValue(i, deviation); });
  }
  AddCamera(block, view.camera, view.imageFile);
  return block;
}

std::string ImageFileOf(vtkPolyData* block)
{
  auto* file = vtkStringArray::SafeDownCast(block->GetFieldData()->GetAbstractArray("ImageFile"));
  return file && file->GetNumberOfValues() > 0 ? file->GetValue(0) : std::string();
}

void ReadPoints(vtkPolyData* block, View& view)
{
  const vtkIdType count = block->GetNumberOfPoints();
  view.points.resize(count);
  view.imagePoints.resize(count);
  if (count == 0)
  {
    return;
  }
  vtkDataArray* imagePoints = PointArray(block, "ImagePoint", 2, view.name);
  for (vtkIdType i = 0; i < count; ++i)
  {
    block->GetPoint(i, view.points[i].data());
    imagePoints->GetTuple(i, view.imagePoints[i].data());
  }
  if (block->GetPointData()->HasArray("DisparityDeviation"))
  {
    vtkDataArray* deviations = PointArray(block, "DisparityDeviation", 1, view.name);
    view.deviations.resize(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      view.deviations[i] = deviations->GetComponent(i, 0);
      if (!(view.deviations[i] >= 0))
      {
        throw Error(
          "View '" + view.name + "' has a DisparityDeviation that is negative or no number.");
      }
    }
  }
}

// Polylines come apart into the edges between their points.
void ReadEdges(vtkPolyData* block, View& view)
{
  const vtkIdType count = block->GetNumberOfPoints();
  vtkCellArray* lines = block->GetLines();
  for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    lines->GetCellAtId(cell, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      if (ids[i] < 0 || ids[i] >= count)
      {
        throw Error("View '" + view.name + "' has a line that is not between its points.");
      }
      if (i > 0)
      {
        view.edges.push_back({ static_cast<int>(ids[i - 1]), static_cast<int>(ids[i]) });
      }
    }
  }
}

void ReadTriangles(vtkPolyData* block, DisparityMap& map)
{
  const vtkIdType count = block->GetNumberOfPoints();
  vtkCellArray* polys = block->GetPolys();
  map.triangles.reserve(polys->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < polys->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    polys->GetCellAtId(cell, size, ids);
    bool valid = size == 3;
    for (vtkIdType i = 0; valid && i < 3; ++i)
    {
      valid = ids[i] >= 0 && ids[i] < count;
    }
    if (!valid)
    {
      throw Error("View '" + map.name + "' has a cell that is not a triangle of its points.");
    }
    map.triangles.push_back(
      { static_cast<int>(ids[0]), static_cast<int>(ids[1]), static_cast<int>(ids[2]) });
  }
}

vtkPolyData* PolyDataBlock(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(index));
  if (!block)
  {
    throw Error("View '" + BlockName(blocks, index) + "' is not a vtkPolyData.");
  }
  return block;
}

}

vtkSmartPointer<vtkPolyData> BlockFromView(const View& view)
{
  auto block = BlockWithPoints(view);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  block->SetVerts(vertices);
  vtkNew<vtkCellArray> lines;
  for (const auto& edge : view.edges)
  {
    const vtkIdType ids[2] = { edge[0], edge[1] };
    lines->InsertNextCell(2, ids);
  }
  block->SetLines(lines);
  return block;
}

vtkSmartPointer<vtkPolyData> BlockFromEdgeView(const EdgeView& view)
{
  auto block = BlockFromView(view);
  AddPointArray<vtkUnsignedCharArray>(block, "RGB", 3, view.colors,
    [](vtkUnsignedCharArray* array, vtkIdType i, const std::array<std::uint8_t, 3>& color)
    { array->SetTypedTuple(i, color.data()); });
  AddPointArray<vtkDoubleArray>(block, "EdgeDirection", 3, view.edgeDirections,
    [](vtkDoubleArray* array, vtkIdType i, const Eigen::Vector3d& direction)
    { array->SetTypedTuple(i, direction.data()); });
  AddPointArray<vtkDoubleArray>(block, "MatchingCost", 1, view.matchingCosts,
    [](vtkDoubleArray* array, vtkIdType i, double cost) { array->SetValue(i, cost); });
  AddPointArray<vtkIntArray>(block, "ChainId", 1, view.chainIds,
    [](vtkIntArray* array, vtkIdType i, int id) { array->SetValue(i, id); });
  vtkNew<vtkCellArray> lines;
  for (const std::vector<int>& chain : view.chains)
  {
    lines->InsertNextCell(static_cast<int>(chain.size()));
    for (int point : chain)
    {
      lines->InsertCellPoint(point);
    }
  }
  block->SetLines(lines);
  return block;
}

vtkSmartPointer<vtkPolyData> BlockFromMap(const DisparityMap& map)
{
  auto block = BlockWithPoints(map);
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(
    static_cast<vtkIdType>(map.triangles.size()), 3 * static_cast<vtkIdType>(map.triangles.size()));
  for (const auto& triangle : map.triangles)
  {
    const vtkIdType ids[3] = { triangle[0], triangle[1], triangle[2] };
    triangles->InsertNextCell(3, ids);
  }
  block->SetPolys(triangles);

  vtkNew<vtkIntArray> sourceView;
  sourceView->SetName("SourceView");
  sourceView->SetNumberOfValues(static_cast<vtkIdType>(map.sourceView.size()));
  std::copy(map.sourceView.begin(), map.sourceView.end(), sourceView->GetPointer(0));
  block->GetPointData()->AddArray(sourceView);
  return block;
}

View ViewFromBlock(vtkPolyData* block, const std::string& name)
{
  View view;
  view.name = name;
  view.imageFile = ImageFileOf(block);
  view.camera = CameraFromBlock(block, name);
  ReadPoints(block, view);
  ReadEdges(block, view);
  return view;
}

DisparityMap MapFromBlock(vtkPolyData* block, const std::string& name, int ownIndex)
{
  DisparityMap map;
  static_cast<View&>(map) = ViewFromBlock(block, name);
  ReadTriangles(block, map);
  map.sourceView.assign(map.points.size(), ownIndex);
  if (block->GetPointData()->HasArray("SourceView"))
  {
    vtkDataArray* source = PointArray(block, "SourceView", 1, name);
    for (std::size_t i = 0; i < map.sourceView.size(); ++i)
    {
      map.sourceView[i] = IntFrom(source->GetComponent(static_cast<vtkIdType>(i), 0), name);
    }
  }
  return map;
}

std::string BlockName(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  if (blocks->HasMetaData(index))
  {
    if (const char* name = blocks->GetMetaData(index)->Get(vtkCompositeDataSet::NAME()))
    {
      return name;
    }
  }
  return "block " + std::to_string(index);
}

std::vector<View> ViewsFromBlocks(vtkMultiBlockDataSet* blocks)
{
  std::vector<View> views;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    views.push_back(ViewFromBlock(PolyDataBlock(blocks, i), BlockName(blocks, i)));
  }
  return views;
}

DisparityMap MapFromBlocks(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  return MapFromBlock(
    PolyDataBlock(blocks, index), BlockName(blocks, index), static_cast<int>(index));
}

std::vector<DisparityMap> MapsFromBlocks(vtkMultiBlockDataSet* blocks)
{
  std::vector<DisparityMap> maps;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    maps.push_back(MapFromBlocks(blocks, i));
  }
  return maps;
}

void SetNamedBlock(
  vtkMultiBlockDataSet* blocks, unsigned int index, const std::string& name, vtkPolyData* block)
{
  blocks->SetBlock(index, block);
  blocks->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

vtkSmartPointer<vtkMultiBlockDataSet> WithNames(
  vtkMultiBlockDataSet* blocks, std::string (*changed)(const std::string&))
{
  auto result = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  result->ShallowCopy(blocks);
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    if (vtkDataObject* block = blocks->GetBlock(i))
    {
      auto copy = vtkSmartPointer<vtkDataObject>::Take(block->NewInstance());
      copy->ShallowCopy(block);
      auto* file =
        vtkStringArray::SafeDownCast(block->GetFieldData()->GetAbstractArray("ImageFile"));
      if (file && file->GetNumberOfValues() > 0)
      {
        vtkNew<vtkStringArray> own;
        own->SetName("ImageFile");
        own->InsertNextValue(changed(file->GetValue(0)));
        copy->GetFieldData()->AddArray(own); // instead of the shared one
      }
      result->SetBlock(i, copy);
    }
    if (blocks->HasMetaData(i))
    {
      result->GetMetaData(i)->Set(
        vtkCompositeDataSet::NAME(), changed(BlockName(blocks, i)).c_str());
    }
  }
  return result;
}

}
