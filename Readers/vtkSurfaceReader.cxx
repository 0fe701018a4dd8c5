// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceReader.h"

#include "Execution/AlgorithmErrors.h"
#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/ObservedTriangles.h"
#include "Data/SurfaceMesh.h"
#include "Data/SurfaceViewpoint.h"
#include "Data/ViewBlocks.h"
#include "Files/GlobalShift.h"
#include "Surface/SurfaceFile.h"
#include "XML/XMLFileCheck.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <cstring>

vtkStandardNewMacro(vtkSurfaceReader);

namespace
{

// See vtkSurfaceWriter::GlobalShift.
void AddGlobalShiftOfField(vtkPolyData* surface)
{
  vtkDataArray* array = surface->GetFieldData()->GetArray("GlobalShift");
  if (array && array->GetNumberOfTuples() == 1 && array->GetNumberOfComponents() == 3)
  {
    surface->SetPoints(freespace::MovedPoints(surface, Eigen::Vector3d(array->GetTuple(0))));
    surface->GetFieldData()->RemoveArray("GlobalShift");
  }
}

vtkSmartPointer<vtkPolyData> ReadVTP(const std::string& fileName)
{
  freespace::CheckXMLFile(fileName);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand>
    silence; // what is wrong is told below, in a sentence that names the file
  reader->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->SetReaderErrorObserver(silence);
  reader->SetParserErrorObserver(silence);
  reader->Update();
  vtkSmartPointer<vtkPolyData> surface = reader->GetOutput();
  freespace::CheckCells(surface, fileName);
  AddGlobalShiftOfField(surface);
  return surface;
}

// The viewpoint of a surface and its global shift are comments of its file, see SurfaceViewpoint.h and GlobalShift.h.
void ReadComments(const freespace::SurfaceFile& file, vtkPolyData* surface)
{
  for (const std::string& comment : file.comments)
  {
    if (const auto viewpoint = freespace::ViewpointFromComment(comment))
    {
      freespace::AddCamera(surface, *viewpoint, "");
    }
    if (const auto shift = freespace::GlobalShiftFromComment(comment))
    {
      surface->SetPoints(freespace::MovedPoints(surface, *shift));
    }
  }
}

vtkSmartPointer<vtkPolyData> SurfaceFrom(const freespace::SurfaceFile& file)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(file.isDouble ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(static_cast<vtkIdType>(file.points.size()));
  for (std::size_t i = 0; i < file.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), file.points[i].data());
  }
  surface->SetPoints(points);
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(
    static_cast<vtkIdType>(file.ends.size()), static_cast<vtkIdType>(file.corners.size()));
  std::int64_t begin = 0;
  for (std::int64_t end : file.ends)
  {
    polygons->InsertNextCell(static_cast<int>(end - begin));
    for (; begin < end; ++begin)
    {
      polygons->InsertCellPoint(file.corners[static_cast<std::size_t>(begin)]);
    }
  }
  surface->SetPolys(polygons);
  if (!file.colors.empty() && file.colors.size() == file.points.size())
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("RGB");
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(static_cast<vtkIdType>(file.colors.size()));
    std::memcpy(colors->GetPointer(0), file.colors.data(), 3 * file.colors.size());
    surface->GetPointData()->SetScalars(colors);
  }
  ReadComments(file, surface);
  return surface;
}

vtkSmartPointer<vtkPolyData> ReadByEnding(const std::string& fileName)
{
  const std::string ending = freespace::LowerCaseExtension(fileName);
  if (ending == ".ply")
  {
    return SurfaceFrom(freespace::ReadPLY(fileName));
  }
  if (ending == ".stl")
  {
    return SurfaceFrom(freespace::ReadSTL(fileName));
  }
  if (ending == ".obj")
  {
    return SurfaceFrom(freespace::ReadOBJ(fileName));
  }
  if (ending == ".vtp")
  {
    return ReadVTP(fileName);
  }
  throw freespace::Error(
    "Cannot read '" + fileName + "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
}

bool IsFinite(vtkPoints* points)
{
  double point[3];
  for (vtkIdType i = 0; points && i < points->GetNumberOfPoints(); ++i)
  {
    points->GetPoint(i, point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      return false;
    }
  }
  return true;
}

}

vtkSurfaceReader::vtkSurfaceReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkSurfaceReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const auto surface = ReadByEnding(this->FileName);
    if (!IsFinite(surface->GetPoints()))
    {
      throw freespace::Error(
        "Cannot read " + this->FileName + ": it has a point that is not finite.");
    }
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputData(surface);
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    triangles->Update();
    if (triangles->GetOutput()->GetNumberOfPolys() == 0)
    {
      throw freespace::Error(
        "Cannot read " + this->FileName + ": it is truncated, or holds no surface.");
    }
    output->ShallowCopy(triangles->GetOutput());
    freespace::DropRepeated(output);
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
