// SPDX-License-Identifier: BSD-3-Clause
#include "BlocksFromBytes.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace freespace
{

namespace
{

class Source
{
public:
  explicit Source(std::string_view bytes)
    : Rest(bytes)
  {
  }

  /// 0 at the end, and where nothing is to be changed.
  int Byte()
  {
    const int byte = this->Rest.empty() ? 0 : static_cast<unsigned char>(this->Rest.front());
    this->Rest.remove_prefix(this->Rest.empty() ? 0 : 1);
    return byte;
  }

  /// Mostly near to the given one.
  double Number(double usual)
  {
    static const double odd[] = { 0.0, -1.0, 1e-300, 1e40, -1e300,
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 1e6, -0.5,
      1e-9, 5e8, 2147483648.0, -1e19, 0.5, 640.0, 3.0 };
    const int byte = this->Byte();
    return byte == 0 ? usual : byte < 240 ? usual + (byte - 120) * 0.01 : odd[byte - 240];
  }

  bool IsEmpty() const { return this->Rest.empty(); }

private:
  std::string_view Rest;
};

vtkSmartPointer<vtkDataArray> NewArray(int kind, vtkSmartPointer<vtkDataArray> usual)
{
  return kind == 1 ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkFloatArray>::New())
    : kind == 2    ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkIntArray>::New())
    : kind == 3    ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkUnsignedCharArray>::New())
                   : usual;
}

// An array of these values, or one that is nearly it; null where it is left out.
vtkSmartPointer<vtkDataArray> MakeArray(
  Source& source, const char* name, int components, const std::vector<double>& values, bool isInt)
{
  const int change = source.Byte();
  if (change == 1)
  {
    return nullptr;
  }
  const auto usual = isInt ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkIntArray>::New())
                           : vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkDoubleArray>::New());
  auto array = NewArray(change - 2, usual);
  const auto size = static_cast<vtkIdType>(values.size());
  array->SetName(name);
  // One wide tuple, single numbers, one tuple less, or as it should be.
  array->SetNumberOfComponents(change == 6 ? std::max(1, int(size)) : change == 7 ? 1 : components);
  array->SetNumberOfTuples(change == 6 ? 1
      : change == 7                    ? size
                                       : size / components - (change == 8 ? 1 : 0));
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    const double value = source.Number(values[static_cast<std::size_t>(i)]);
    const bool fits = std::isfinite(value) && std::abs(value) < 1e9;
    const bool isReal = array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT;
    array->SetComponent(i / array->GetNumberOfComponents(),
      static_cast<int>(i % array->GetNumberOfComponents()), isReal || fits ? value : 0.0);
  }
  return array;
}

constexpr int Side = 4; // of the grid of features

void AddArrays(Source& source, vtkPolyData* block)
{
  std::vector<double> points, pixels, views;
  for (int i = 0; i < Side * Side; ++i)
  {
    const double x = (i % Side - 1.5) * 0.5, y = (i / Side - 1.5) * 0.5, z = 4 + 0.3 * (i % 3);
    points.insert(points.end(), { x, y, z });
    pixels.insert(pixels.end(), { 320 + 500 * x / z, 240 + 500 * y / z });
    views.push_back(i % 2);
  }
  if (const auto array = MakeArray(source, "Points", 3, points, false);
      array && array->GetNumberOfComponents() == 3)
  {
    vtkNew<vtkPoints> at;
    at->SetData(array);
    block->SetPoints(at);
  }
  const auto add = [](vtkFieldData* to, vtkDataArray* array)
  {
    if (array)
    {
      to->AddArray(array);
    }
  };
  vtkFieldData* field = block->GetFieldData();
  add(block->GetPointData(), MakeArray(source, "ImagePoint", 2, pixels, false));
  add(block->GetPointData(), MakeArray(source, "SourceView", 1, views, true));
  add(
    field, MakeArray(source, "CameraIntrinsics", 9, { 500, 0, 320, 0, 500, 240, 0, 0, 1 }, false));
  add(
    field, MakeArray(source, "CameraFromWorld", 12, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 }, false));
  add(field, MakeArray(source, "ImageSize", 2, { 640, 480 }, true));
  vtkNew<vtkStringArray> file;
  file->SetName("ImageFile");
  file->SetNumberOfValues(source.Byte() == 1 ? 0 : 1);
  field->AddArray(file);
}

// Two triangles in each square of the grid; ids of bytes where they say so, among the points or not.
void AddTriangles(Source& source, vtkPolyData* block)
{
  vtkNew<vtkCellArray> triangles;
  const int change = source.Byte();
  for (int i = 0; change != 1 && i < (Side - 1) * (Side - 1); ++i)
  {
    const vtkIdType a = i / (Side - 1) * Side + i % (Side - 1);
    vtkIdType corners[2][4] = { { a, a + 1, a + Side, a }, { a + 1, a + Side + 1, a + Side, a } };
    for (vtkIdType* triangle : { corners[0], corners[1] })
    {
      if (change == 2)
      {
        triangle[source.Byte() % 3] += source.Byte() - 8;
      }
      triangles->InsertNextCell(change == 3 ? 1 + source.Byte() % 4 : 3, triangle);
    }
  }
  block->SetPolys(triangles);
}

}

vtkSmartPointer<vtkMultiBlockDataSet> BlocksFromBytes(std::string_view bytes)
{
  Source source(bytes);
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const int count = 1 + source.Byte() % 3;
  for (int i = 0; i < count; ++i)
  {
    const auto at = static_cast<unsigned int>(i);
    const int change = source.Byte();
    if (change == 1)
    {
      blocks->SetBlock(at, nullptr);
      continue;
    }
    if (change == 2)
    {
      blocks->SetBlock(at, vtkSmartPointer<vtkImageData>::New());
      continue;
    }
    const auto block = vtkSmartPointer<vtkPolyData>::New();
    AddArrays(source, block);
    AddTriangles(source, block);
    blocks->SetBlock(at, block);
    if (change != 3)
    {
      blocks->GetMetaData(at)->Set(vtkCompositeDataSet::NAME(), "view");
    }
  }
  return blocks;
}

}
