// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "Error.h"
#include "Session.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSurfacePicture.h>

#include <filesystem>

namespace freespace
{

void WritePicture(
  Session& session, vtkPolyData* surface, vtkPolyData* view, const std::string& fileName)
{
  if (std::filesystem::path(fileName).extension() != ".png")
  {
    throw Error("Cannot write '" + fileName + "': the name of a picture ends in .png.");
  }
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(surface);
  if (view)
  {
    picture->SetViewBlock(view);
  }
  session.Run(picture, "render");
  picture->WritePNG(fileName);
  session.ThrowIfFailed();
}

}
