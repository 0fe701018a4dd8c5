// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCalibratedCamera.h"

#include "CameraForVTK.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkCalibratedCamera);

int vtkCalibratedCamera::Apply(vtkCamera* camera, const double intrinsics[9],
  const double cameraFromWorld[12], const int imageSize[2])
{
  try
  {
    freespace::ApplyCamera(
      freespace::CameraFromArrays(intrinsics, cameraFromWorld, imageSize), camera);
    return 1;
  }
  catch (const freespace::Error& error)
  {
    vtkErrorWithObjectMacro(camera, << error.what());
    return 0;
  }
}

int vtkCalibratedCamera::ApplyViewBlock(vtkCamera* camera, vtkPolyData* block)
{
  try
  {
    const freespace::Camera calibrated = freespace::ViewFromBlock(block, "to look from").camera;
    freespace::CheckCamera(calibrated);
    freespace::ApplyCamera(calibrated, camera);
    return 1;
  }
  catch (const freespace::Error& error)
  {
    vtkErrorWithObjectMacro(camera, << error.what());
    return 0;
  }
}

void vtkCalibratedCamera::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
