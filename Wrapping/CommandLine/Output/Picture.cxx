// SPDX-License-Identifier: BSD-3-Clause
#include "Output/Picture.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Output/SurfaceFiles.h"
#include "Session/Session.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSurfacePicture.h>

namespace freespace
{

void CheckPictureName(const std::string& fileName)
{
  CheckOutputFolder(fileName);
  if (LowerCaseExtension(fileName) != ".png")
  {
    throw Error("Cannot write '" + fileName + "': the name of a picture ends in .png.");
  }
}

void WritePicture(Session& session, vtkPolyData* surface, vtkPolyData* view,
  const PictureLook& look, const std::string& fileName)
{
  CheckPictureName(fileName);
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(surface);
  picture->SetSize(look.size[0], look.size[1]);
  picture->SetUseViewpoint(look.useViewpoint);
  picture->SetAzimuth(look.azimuth);
  picture->SetElevation(look.elevation);
  picture->SetUp(look.up[0], look.up[1], look.up[2]);
  picture->SetZoom(look.zoom);
  picture->SetBackground(look.background[0], look.background[1], look.background[2]);
  picture->SetEdges(look.edges);
  picture->SetColorArray(look.colorArray);
  if (view)
  {
    picture->SetViewBlock(view);
    session.ThrowIfFailed();
  }
  session.Run(picture, "render");
  picture->WritePNG(fileName);
  session.ThrowIfFailed();
  session.Log("wrote " + fileName);
}

}
