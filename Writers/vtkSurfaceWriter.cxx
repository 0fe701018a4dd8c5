// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceWriter.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Common/FileExtension.h"
#include "Data/SurfaceViewpoint.h"
#include "PlyWriter.h"
#include "RunWriter.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <filesystem>
#include <limits>

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

// An STL has single precision, in which the vertices of a surface far from the origin fall together.
void CheckSinglePrecision(vtkPolyData* surface, const std::string& fileName)
{
  constexpr double mostRounding = 1e-5; // of the diagonal
  double bounds[6];
  surface->GetBounds(bounds);
  const double room = mostRounding * surface->GetLength();
  for (const double bound : bounds)
  {
    if (!(std::abs(bound) * std::numeric_limits<float>::epsilon() / 2 <= room &&
          std::abs(bound) <= std::numeric_limits<float>::max()))
    {
      throw freespace::Error("Cannot write " + fileName +
        ": an STL has single precision, which is too little for a surface so far from the origin; "
        "a .ply, .obj or .vtp keeps it.");
    }
  }
}

bool WriteByEnding(vtkPolyData* surface, const std::string& ending, const std::string& fileName,
  const std::string& target)
{
  if (ending == ".ply")
  {
    return freespace::WritePLY(surface, "RGB", freespace::ViewpointComment(surface), fileName);
  }
  if (ending == ".stl")
  {
    CheckSinglePrecision(surface, target);
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    return WriteWith(writer.Get(), surface, fileName);
  }
  if (ending == ".obj")
  {
    vtkNew<vtkOBJWriter> writer;
    return WriteWith(writer.Get(), surface, fileName);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  return WriteWith(writer.Get(), surface, fileName);
}

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
      if (!WriteByEnding(surface, ending, written.string(), this->FileName))
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
}
