// SPDX-License-Identifier: BSD-3-Clause
#include "Export/FeatureExport.h"

#include "Data/ViewBlocks.h"
#include "Export/CameraFrusta.h"
#include "Tables/TextTable.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <functional>

namespace freespace
{

namespace
{

vtkPolyData* BlockOf(vtkMultiBlockDataSet* views, unsigned int index)
{
  return vtkPolyData::SafeDownCast(views->GetBlock(index));
}

vtkUnsignedCharArray* ColorsOf(vtkPolyData* block)
{
  auto* colors = vtkUnsignedCharArray::SafeDownCast(block->GetPointData()->GetArray("RGB"));
  return colors && colors->GetNumberOfComponents() == 3 ? colors : nullptr;
}

bool AreColored(vtkMultiBlockDataSet* views)
{
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    if (!ColorsOf(BlockOf(views, i)))
    {
      return false;
    }
  }
  return true;
}

/// Gathers points of blocks.
struct Gathered
{
  explicit Gathered(bool isColored)
    : IsColored(isColored)
  {
    this->Points->SetDataTypeToDouble();
    this->View->SetName("View");
    this->Colors->SetName("RGB");
    this->Colors->SetNumberOfComponents(3);
  }

  vtkIdType Add(vtkPolyData* block, vtkIdType point, int view)
  {
    this->View->InsertNextValue(view);
    if (this->IsColored)
    {
      this->Colors->InsertNextTuple(point, ColorsOf(block));
    }
    return this->Points->InsertNextPoint(block->GetPoint(point));
  }

  vtkSmartPointer<vtkPolyData> Finish()
  {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(this->Points);
    result->GetPointData()->AddArray(this->View);
    if (this->IsColored)
    {
      result->GetPointData()->SetScalars(this->Colors);
    }
    return result;
  }

  bool IsColored;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkIntArray> View;
  vtkNew<vtkUnsignedCharArray> Colors;
};

std::vector<Camera> CamerasOf(vtkMultiBlockDataSet* views)
{
  std::vector<Camera> cameras;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    cameras.push_back(CameraFromBlock(BlockOf(views, i), BlockName(views, i)));
  }
  return cameras;
}

// The names of arrays of one number that all blocks have.
std::vector<std::string> CommonArrays(vtkMultiBlockDataSet* views)
{
  std::vector<std::string> names;
  vtkPointData* first =
    views->GetNumberOfBlocks() > 0 ? BlockOf(views, 0)->GetPointData() : nullptr;
  for (int k = 0; first && k < first->GetNumberOfArrays(); ++k)
  {
    const std::string name = first->GetArrayName(k) ? first->GetArrayName(k) : "";
    bool isCommon = !name.empty();
    for (unsigned int i = 0; i < views->GetNumberOfBlocks() && isCommon; ++i)
    {
      vtkDataArray* array = BlockOf(views, i)->GetPointData()->GetArray(name.c_str());
      isCommon = array && array->GetNumberOfComponents() == 1;
    }
    if (isCommon)
    {
      names.push_back(name);
    }
  }
  return names;
}

}

vtkSmartPointer<vtkPolyData> FeaturePoints(vtkMultiBlockDataSet* views)
{
  Gathered gathered(AreColored(views));
  vtkNew<vtkCellArray> vertices;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    for (vtkIdType p = 0; p < BlockOf(views, i)->GetNumberOfPoints(); ++p)
    {
      const vtkIdType point = gathered.Add(BlockOf(views, i), p, static_cast<int>(i));
      vertices->InsertNextCell(1, &point);
    }
  }
  auto points = gathered.Finish();
  points->SetVerts(vertices);
  return points;
}

vtkSmartPointer<vtkPolyData> FeatureChains(vtkMultiBlockDataSet* views)
{
  Gathered gathered(AreColored(views));
  vtkNew<vtkCellArray> chains;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    vtkPolyData* block = BlockOf(views, i);
    std::vector<vtkIdType> place(block->GetNumberOfPoints(), -1);
    vtkCellArray* lines = block->GetLines();
    for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
    {
      vtkIdType size = 0;
      const vtkIdType* corners = nullptr;
      lines->GetCellAtId(line, size, corners);
      chains->InsertNextCell(static_cast<int>(size));
      for (vtkIdType k = 0; k < size; ++k)
      {
        vtkIdType& point = place[corners[k]];
        point = point < 0 ? gathered.Add(block, corners[k], static_cast<int>(i)) : point;
        chains->InsertCellPoint(point);
      }
    }
  }
  auto result = gathered.Finish();
  result->SetLines(chains);
  return result;
}

std::string FeatureRows(vtkMultiBlockDataSet* views)
{
  const bool isColored = AreColored(views);
  const std::vector<std::string> arrays = CommonArrays(views);
  std::string text = "view,x,y,z,pixel_x,pixel_y,depth";
  text += isColored ? ",red,green,blue" : "";
  for (const std::string& name : arrays)
  {
    text += "," + CsvCell(name);
  }
  text += "\n";
  const auto number = [](double value) { return "," + NumberText(value, 17); };
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    vtkPolyData* block = BlockOf(views, i);
    const std::string name = CsvCell(BlockName(views, i));
    const View view = ViewFromBlock(block, BlockName(views, i));
    for (std::size_t p = 0; p < view.points.size(); ++p)
    {
      const Eigen::Vector3d& point = view.points[p];
      text += name + number(point.x()) + number(point.y()) + number(point.z()) +
        number(view.imagePoints[p].x()) + number(view.imagePoints[p].y()) +
        number(view.camera.Depth(point));
      for (int channel = 0; channel < 3 && isColored; ++channel)
      {
        text += number(ColorsOf(block)->GetTypedComponent(static_cast<vtkIdType>(p), channel));
      }
      for (const std::string& array : arrays)
      {
        text += number(
          block->GetPointData()->GetArray(array.c_str())->GetTuple1(static_cast<vtkIdType>(p)));
      }
      text += "\n";
    }
  }
  return text;
}

vtkSmartPointer<vtkPolyData> Frusta(vtkMultiBlockDataSet* cameras, double depth)
{
  const std::vector<Camera> all = CamerasOf(cameras);
  const TriangleMesh mesh = CameraFrusta(all, depth > 0 ? depth : FrustumDepth(all));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& point : mesh.points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    triangles->InsertNextCell({ a, b, c });
  }
  vtkNew<vtkIntArray> number;
  number->SetName("Camera");
  const std::size_t each = mesh.triangles.size() / std::max<std::size_t>(1, all.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    number->InsertNextValue(static_cast<int>(t / each));
  }
  vtkNew<vtkStringArray> names;
  names->SetName("Cameras");
  for (unsigned int i = 0; i < cameras->GetNumberOfBlocks(); ++i)
  {
    names->InsertNextValue(BlockName(cameras, i));
  }
  auto frusta = vtkSmartPointer<vtkPolyData>::New();
  frusta->SetPoints(points);
  frusta->SetPolys(triangles);
  frusta->GetCellData()->AddArray(number);
  frusta->GetFieldData()->AddArray(names);
  return frusta;
}

}
