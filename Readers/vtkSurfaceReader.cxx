// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceReader.h"

#include "Common/Error.h"
#include "Common/FileExtension.h"
#include "Data/SurfaceViewpoint.h"
#include "Data/ViewBlocks.h"
#include "Text/WholeFile.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

vtkStandardNewMacro(vtkSurfaceReader);

namespace
{

// What the inner reader finds wrong is told below, in a sentence that names the file.
void Ignore(vtkObject*, unsigned long, void*, void*) {}

template <typename Reader>
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& fileName)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback(Ignore);
  reader->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  return reader;
}

vtkSmartPointer<vtkAlgorithm> ReaderByEnding(const std::string& fileName)
{
  const std::string ending = freespace::LowerCaseExtension(fileName);
  if (ending == ".ply")
  {
    freespace::CheckWholePLY(fileName);
    return MakeReader<vtkPLYReader>(fileName);
  }
  if (ending == ".stl")
  {
    freespace::CheckWholeSTL(fileName);
    return MakeReader<vtkSTLReader>(fileName);
  }
  if (ending == ".obj")
  {
    return MakeReader<vtkOBJReader>(fileName);
  }
  if (ending == ".vtp")
  {
    freespace::CheckWholeVTKFile(fileName);
    return MakeReader<vtkXMLPolyDataReader>(fileName);
  }
  throw freespace::Error(
    "Cannot read '" + fileName + "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
}

// A .vtp has it in its field data, which came with the rest.
void AddViewpoint(vtkAlgorithm* reader, vtkPolyData* surface)
{
  auto* ply = vtkPLYReader::SafeDownCast(reader);
  vtkStringArray* comments = ply ? ply->GetComments() : nullptr;
  for (vtkIdType i = 0; comments && i < comments->GetNumberOfValues(); ++i)
  {
    if (const auto viewpoint = freespace::ViewpointFromComment(comments->GetValue(i)))
    {
      freespace::AddCamera(surface, *viewpoint, "");
    }
  }
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
  try
  {
    const auto reader = ReaderByEnding(this->FileName);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(reader->GetOutputPort());
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    triangles->Update();
    if (triangles->GetOutput()->GetNumberOfPolys() == 0)
    {
      throw freespace::Error(
        "Cannot read " + this->FileName + ": it is truncated, or holds no surface.");
    }
    output->ShallowCopy(triangles->GetOutput());
    AddViewpoint(reader, output);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
