// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceWriter.h"

#include "Files/AtomicOutput.h"
#include "Files/GlobalShift.h"
#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/Boxes.h"
#include "Data/SurfaceMesh.h"
#include "Data/SurfaceViewpoint.h"
#include "PlyWriter.h"
#include "RunWriter.h"

#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

vtkStandardNewMacro(vtkSurfaceWriter);

namespace
{

template <typename Writer>
bool WriteWith(Writer* writer, vtkPolyData* surface, const std::string& fileName)
{
  writer->SetInputDataObject(surface);
  writer->SetFileName(fileName.c_str());
  return writer->Write() && writer->GetErrorCode() == vtkErrorCode::NoError;
}

vtkSmartPointer<vtkPolyData> Shifted(vtkPolyData* surface, const Eigen::Vector3d& globalShift)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(surface);
  if (!globalShift.isZero(0))
  {
    result->SetPoints(freespace::MovedPoints(surface, -globalShift));
  }
  return result;
}

// An STL has single precision, in which the vertices of a surface far from the origin fall together.
bool WriteSTL(vtkPolyData* shifted, const std::string& shiftComment, const std::string& fileName,
  const std::string& target)
{
  constexpr std::size_t longest = 79; // the header has 80 bytes
  if (shiftComment.size() > longest)
  {
    throw freespace::Error(
      "Cannot write " + target + ": an STL's header holds no global shift with so many digits.");
  }
  if (!freespace::SufficesSingle(freespace::BoxOf(shifted->GetBounds())))
  {
    throw freespace::Error("Cannot write " + target +
      ": an STL has single precision, which is too little for a surface so far from the origin; "
      "a .ply, .obj or .vtp keeps it, or a global shift.");
  }
  vtkNew<vtkSTLWriter> writer;
  writer->SetFileTypeToBinary();
  if (!shiftComment.empty())
  {
    writer->SetHeader(shiftComment.c_str());
  }
  return WriteWith(writer.Get(), shifted, fileName);
}

bool WriteOBJ(vtkPolyData* shifted, const std::string& shiftComment, const std::string& fileName)
{
  vtkNew<vtkOBJWriter> writer;
  if (!WriteWith(writer.Get(), shifted, fileName))
  {
    return false;
  }
  if (!shiftComment.empty())
  {
    std::ofstream file(fileName, std::ios::app);
    file << "# " << shiftComment << "\n";
    file.close();
    return static_cast<bool>(file);
  }
  return true;
}

bool WriteVTP(vtkPolyData* shifted, const Eigen::Vector3d& globalShift, bool isInline,
  const std::string& fileName)
{
  if (!globalShift.isZero(0))
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("GlobalShift");
    values->SetNumberOfComponents(3);
    values->InsertNextTuple(globalShift.data());
    vtkNew<vtkFieldData> fields; // the surface's own stay as they are
    fields->PassData(shifted->GetFieldData());
    fields->AddArray(values);
    shifted->SetFieldData(fields);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  if (isInline)
  {
    writer->SetDataModeToBinary();
  }
  return WriteWith(writer.Get(), shifted, fileName);
}

bool WriteByEnding(vtkPolyData* surface, const Eigen::Vector3d& globalShift,
  const std::string& ending, bool isInline, const std::string& fileName, const std::string& target)
{
  if (ending == ".ply")
  {
    return freespace::WritePLY(
      surface, "RGB", freespace::ViewpointComment(surface), globalShift, fileName);
  }
  const auto shifted = Shifted(surface, globalShift);
  const std::string comment = freespace::GlobalShiftComment(globalShift);
  if (ending == ".stl")
  {
    return WriteSTL(shifted, comment, fileName, target);
  }
  if (ending == ".obj")
  {
    return WriteOBJ(shifted, comment, fileName);
  }
  return WriteVTP(shifted, globalShift, isInline, fileName);
}

}

void vtkSurfaceWriter::SuggestGlobalShift(const double bounds[6], double shift[3])
{
  const Eigen::Vector3d suggested = freespace::SuggestGlobalShift(freespace::BoxOf(bounds));
  std::copy_n(suggested.data(), 3, shift);
}

bool vtkSurfaceWriter::CanWriteFile(const std::string& fileName)
{
  const std::string ending = freespace::LowerCaseExtension(fileName);
  return ending == ".ply" || ending == ".stl" || ending == ".obj" || ending == ".vtp";
}

int vtkSurfaceWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkSurfaceWriter::WriteData()
{
  auto* surface = vtkPolyData::SafeDownCast(this->GetInput());
  this->SetErrorCode(freespace::RunWriter(this, this->FileName,
    [&]
    {
      if (!CanWriteFile(this->FileName))
      {
        throw freespace::Error("Cannot write '" + this->FileName +
          "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
      }
      if (!surface || surface->GetNumberOfCells() == 0)
      {
        throw freespace::Error("Cannot write " + this->FileName + ": the surface is empty.");
      }
      freespace::AtomicOutput target(this->FileName);
      // VTK's PLY writer appends its own ending to any but ".ply".
      const std::string ending = freespace::LowerCaseExtension(this->FileName);
      const std::filesystem::path written =
        std::filesystem::path(target.Path()).replace_extension(ending);
      const Eigen::Vector3d shift(this->GlobalShift);
      if (!shift.allFinite())
      {
        throw freespace::Error("The global shift of a surface must be finite.");
      }
      if (!WriteByEnding(
            surface, shift, ending, this->InlineArrays != 0, written.string(), this->FileName))
      {
        throw target.Failure();
      }
      std::filesystem::rename(written, target.Path());
      target.Commit();
    }));
}

void vtkSurfaceWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "GlobalShift: " << this->GlobalShift[0] << " " << this->GlobalShift[1] << " "
     << this->GlobalShift[2] << "\n";
  os << indent << "InlineArrays: " << this->InlineArrays << "\n";
}
