// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NovelCamera_h
#define freespace_NovelCamera_h

#include <Eigen/Dense>

class vtkActor;
class vtkRenderer;

namespace freespace
{

/// The camera of a renderer in the coordinates of the surface.
struct NovelCamera
{
  Eigen::Vector3d center; ///< of projection; far away for a parallel projection
  double focal = 1;       ///< pixels
  Eigen::Matrix3d axes;   ///< rows: right, up, forward
  Eigen::Matrix4d clipFromSurface;
};

/// The active camera of the renderer; the actor places the surface in the world.
NovelCamera FindNovelCamera(vtkRenderer* renderer, vtkActor* actor);

}

#endif
