// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BakedScene_h
#define freespace_BakedScene_h

#include "Support/Scenes/BlockScene.h"
#include "vtkTextureBaker.h"

#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>

namespace freespace
{

/// A block with the texture of its photographs.
struct BakedScene
{
  BlockScene scene;
  vtkNew<vtkTextureBaker> baker;

  explicit BakedScene(int photographs = 8)
  {
    this->baker->SetInputData(this->scene.Surface());
    this->baker->SetPhotographs(this->scene.Photographs(photographs));
    this->baker->Update();
  }

  /// The texture at a point of a triangle, at the nearest texel, without interpolation.
  std::array<double, 3> Look(vtkIdType triangle, double s, double t, Eigen::Vector3d& point) const
  {
    vtkPolyData* surface = this->baker->GetOutput();
    vtkNew<vtkIdList> ids;
    surface->GetCellPoints(triangle, ids);
    const double weights[3] = { 1 - s - t, s, t };
    point.setZero();
    double u = 0;
    double v = 0;
    for (int i = 0; i < 3; ++i)
    {
      point += weights[i] * Eigen::Vector3d(surface->GetPoint(ids->GetId(i)));
      const double* at = surface->GetPointData()->GetTCoords()->GetTuple(ids->GetId(i));
      u += weights[i] * at[0];
      v += weights[i] * at[1];
    }
    vtkImageData* texture = this->baker->GetTexture();
    const int* size = texture->GetDimensions();
    const auto* texel = static_cast<const unsigned char*>(texture->GetScalarPointer(
      std::min(int(u * size[0]), size[0] - 1), std::min(int(v * size[1]), size[1] - 1), 0));
    return { double(texel[0]), double(texel[1]), double(texel[2]) };
  }
};

}

#endif
