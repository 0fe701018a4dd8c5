// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTexturedSurfaceWriter.h"

#include "BinaryGLTF.h"
#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/PngBytes.h"
#include "PlyWriter.h"
#include "RunWriter.h"

#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <filesystem>
#include <fstream>

vtkStandardNewMacro(vtkTexturedSurfaceWriter);

namespace
{

void WriteColouredPLY(vtkPolyData* surface, const freespace::AtomicOutput& target)
{
  auto* colors = vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetScalars());
  if (!colors || !colors->GetName())
  {
    throw freespace::Error("The surface's points have no named colours for a PLY.");
  }
  if (!freespace::WritePLY(surface, colors->GetName(), "", Eigen::Vector3d::Zero(), target.Path()))
  {
    throw target.Failure();
  }
}

// VTK's writer names the texture with the folder that the files are made in, which is not where they
// end: the three lie beside each other.
void WriteMaterial(const freespace::AtomicOutput& target)
{
  std::filesystem::path material = target.Path();
  const std::string name = material.stem().string();
  std::ofstream file(material.replace_extension(".mtl"));
  file << "newmtl " << name << "\nmap_Kd " << name << ".png\n";
  file.close();
  if (!file)
  {
    throw target.Failure();
  }
}

// The texture beside the model.
void WritePicture(vtkImageData* texture, const freespace::AtomicOutput& target)
{
  const auto bytes = freespace::PngBytes(texture);
  std::ofstream file(
    std::filesystem::path(target.Path()).replace_extension(".png"), std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)), bytes->GetNumberOfValues());
  file.close();
  if (!file)
  {
    throw target.Failure();
  }
}

void WriteOBJ(vtkPolyData* surface, vtkImageData* texture, const freespace::AtomicOutput& target)
{
  // VTK's writer requires a texture to refer to, and writes it; the true one follows.
  vtkNew<vtkImageData> onePixel;
  onePixel->SetDimensions(1, 1, 1);
  onePixel->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkOBJWriter> writer;
  writer->SetInputData(0, surface);
  writer->SetInputData(1, onePixel);
  writer->SetFileName(target.Path().c_str());
  if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw target.Failure();
  }
  WriteMaterial(target);
  WritePicture(texture, target);
}

}

vtkTexturedSurfaceWriter::vtkTexturedSurfaceWriter()
{
  this->SetNumberOfInputPorts(2);
}

bool vtkTexturedSurfaceWriter::CanWriteFile(const std::string& fileName)
{
  const std::string ending = freespace::LowerCaseExtension(fileName);
  return ending == ".glb" || ending == ".obj" || ending == ".ply";
}

int vtkTexturedSurfaceWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

void vtkTexturedSurfaceWriter::WriteData()
{
  auto* surface = vtkPolyData::SafeDownCast(this->GetInputDataObject(0, 0));
  auto* texture = vtkImageData::SafeDownCast(this->GetInputDataObject(1, 0));
  this->SetErrorCode(freespace::RunWriter(this, this->FileName,
    [&]
    {
      if (!CanWriteFile(this->FileName))
      {
        throw freespace::Error("Cannot write '" + this->FileName +
          "': a textured surface's file name ends in .glb, .obj or .ply.");
      }
      const std::string ending = freespace::LowerCaseExtension(this->FileName);
      const bool textured = texture && texture->GetNumberOfPoints() > 0 &&
        texture->GetScalarType() == VTK_UNSIGNED_CHAR && surface->GetPointData()->GetTCoords();
      if (ending != ".ply" && !textured)
      {
        throw freespace::Error("Cannot write " + this->FileName +
          ": the surface has no texture or no coordinates in it.");
      }
      freespace::AtomicOutput target(this->FileName);
      if (ending == ".glb")
      {
        freespace::WriteBinaryGLTF(surface, texture, this->ZUp != 0, target);
      }
      else if (ending == ".obj")
      {
        WriteOBJ(surface, texture, target);
      }
      else
      {
        WriteColouredPLY(surface, target);
      }
      target.Commit();
    }));
}

void vtkTexturedSurfaceWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "ZUp: " << this->ZUp << "\n";
}
