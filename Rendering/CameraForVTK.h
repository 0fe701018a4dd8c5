// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraForVTK_h
#define freespace_CameraForVTK_h

#include "Common/Camera.h"

class vtkCamera;

namespace freespace
{

/// The camera of row-major arrays. Throws Error when it is not one.
Camera CameraFromArrays(
  const double intrinsics[9], const double cameraFromWorld[12], const int imageSize[2]);

/// Throws Error when values are not finite, R is no rotation, or a focal length or the size is not
/// positive.
void CheckCamera(const Camera& camera);

/// Makes a vtkCamera see what the camera sees, see vtkCalibratedCamera.
void ApplyCamera(const Camera& camera, vtkCamera* target);

}

#endif
