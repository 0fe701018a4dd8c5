// SPDX-License-Identifier: BSD-3-Clause
#include "CameraForVTK.h"

#include "Common/Error.h"

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkMatrixToHomogeneousTransform.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <cmath>

namespace freespace
{

Camera CameraFromArrays(
  const double intrinsics[9], const double cameraFromWorld[12], const int imageSize[2])
{
  Camera camera;
  camera.K = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(intrinsics);
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> pose(cameraFromWorld);
  camera.R = pose.leftCols<3>();
  camera.t = pose.col(3);
  camera.width = imageSize[0];
  camera.height = imageSize[1];
  CheckCamera(camera);
  return camera;
}

void CheckCamera(const Camera& camera)
{
  if (!camera.K.allFinite() || !camera.R.allFinite() || !camera.t.allFinite())
  {
    throw Error("The camera has a value that is not finite.");
  }
  if (!camera.R.isUnitary(1e-6) || camera.R.determinant() < 0)
  {
    throw Error("The camera's pose has a matrix that is no rotation.");
  }
  const bool triangular = camera.K(1, 0) == 0 && camera.K.row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!triangular || !(camera.K(0, 0) > 0) || !(camera.K(1, 1) > 0))
  {
    throw Error("The camera's intrinsics are not upper triangular with positive focal lengths.");
  }
  if (camera.width < 1 || camera.height < 1)
  {
    throw Error("The camera's image has no pixels.");
  }
}

namespace
{

// VTK's frustum has one focal length, fy, and a window centre. What the camera has beyond this is
// an affine map of normalized device coordinates, x' = a x + b y + c, and y' = y.
void ApplyIntrinsics(const Camera& camera, vtkCamera* target)
{
  const double width = camera.width;
  const double height = camera.height;
  const Eigen::Matrix3d& K = camera.K;
  const double aspect = K(0, 0) / K(1, 1);
  const double centerX = (1.0 - 2.0 * K(0, 2) / width) / aspect;
  const double centerY = 2.0 * K(1, 2) / height - 1.0;
  target->ParallelProjectionOff();
  target->UseHorizontalViewAngleOff();
  target->SetUseExplicitProjectionTransformMatrix(false);
  target->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(height / (2.0 * K(1, 1)))));
  target->SetWindowCenter(centerX, centerY);
  if (aspect == 1.0 && K(0, 1) == 0.0)
  {
    target->SetUserTransform(nullptr);
    return;
  }
  const double skew = -K(0, 1) / K(1, 1) * height / width;
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 0, aspect);
  matrix->SetElement(0, 1, skew);
  matrix->SetElement(0, 3, skew * centerY);
  vtkNew<vtkMatrixToHomogeneousTransform> transform;
  transform->SetInput(matrix);
  target->SetUserTransform(transform);
}

}

void ApplyCamera(const Camera& camera, vtkCamera* target)
{
  const Eigen::Vector3d position = camera.Center();
  const Eigen::Vector3d forward = camera.R.row(2);
  const Eigen::Vector3d focal = position + forward;
  const Eigen::Vector3d up = -camera.R.row(1);
  vtkNew<vtkMatrix4x4> identity;
  target->SetModelTransformMatrix(identity.Get());
  target->SetUserViewTransform(nullptr);
  target->SetViewShear(0.0, 0.0, 1.0);
  target->SetPosition(position.data());
  target->SetFocalPoint(focal.data());
  target->SetViewUp(up.data());
  ApplyIntrinsics(camera, target);
}

}
