// SPDX-License-Identifier: BSD-3-Clause
#include "Output/SurfaceFiles.h"

#include "Files/AtomicOutput.h"
#include "Files/GlobalShift.h"
#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Data/Boxes.h"
#include "Session/Session.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSurfaceReader.h>
#include <vtkSurfaceWriter.h>

namespace freespace
{

vtkSmartPointer<vtkPolyData> ReadSurface(Session& session, const std::string& fileName)
{
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(fileName);
  session.Run(reader, "read");
  return reader->GetOutput();
}

void WriteSurface(Session& session, vtkPolyData* surface, const std::string& fileName,
  const GlobalShiftOption& globalShift)
{
  const Eigen::Vector3d shift = globalShift.For(BoxOf(surface->GetBounds()));
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputDataObject(surface);
  writer->SetFileName(fileName);
  writer->SetGlobalShift(shift.data());
  session.Write(writer);
  const std::string told = GlobalShiftComment(shift);
  session.Log("wrote " + fileName + (told.empty() ? "" : ", " + told));
}

void CheckOutputFolder(const std::string& fileName)
{
  const AtomicOutput probe(fileName);
}

void CheckSurfaceName(const std::string& fileName)
{
  CheckOutputFolder(fileName);
  if (!vtkSurfaceWriter::CanWriteFile(fileName))
  {
    throw Error(
      "Cannot write '" + fileName + "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
  }
}

}
