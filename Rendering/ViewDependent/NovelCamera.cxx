// SPDX-License-Identifier: BSD-3-Clause
#include "ViewDependent/NovelCamera.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <cmath>

namespace freespace
{

namespace
{

Eigen::Matrix4d ToEigen(vtkMatrix4x4* matrix)
{
  return Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix->GetData());
}

}

NovelCamera FindNovelCamera(vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> worldFromSurface;
  actor->GetMatrix(worldFromSurface);
  const Eigen::Matrix4d viewFromSurface =
    ToEigen(camera->GetModelViewTransformMatrix()) * ToEigen(worldFromSurface);
  const Eigen::Matrix4d surfaceFromView = viewFromSurface.inverse();
  NovelCamera novel;
  novel.clipFromSurface =
    ToEigen(camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1)) *
    ToEigen(worldFromSurface);
  for (int i = 0; i < 3; ++i)
  {
    const double sign = i == 2 ? -1 : 1; // VTK looks along -z
    novel.axes.row(i) = sign * surfaceFromView.block<3, 1>(0, i).normalized();
  }
  double height = renderer->GetSize()[1];
  if (camera->GetParallelProjection())
  {
    const double far = 1e4 * camera->GetDistance();
    novel.center = (surfaceFromView * Eigen::Vector4d(0, 0, far, 1)).head<3>();
    novel.focal = height * far / (2 * camera->GetParallelScale());
  }
  else
  {
    novel.center = surfaceFromView.block<3, 1>(0, 3);
    const double halfAngle = vtkMath::RadiansFromDegrees(camera->GetViewAngle()) / 2;
    novel.focal = height / (2 * std::tan(halfAngle));
  }
  return novel;
}

}
