// SPDX-License-Identifier: BSD-3-Clause
// A project of somebody else's that uses the mathematics without VTK.
#include <freespace/Contour/BisectionContour.h>
#include <freespace/Freespace/FreespaceUnion.h>
#include <freespace/Scene/Scene.h>
#include <freespace/Viewpoints/LookAt.h>

namespace
{

class Ball : public freespace::ContourField
{
public:
  bool IsFree(const Eigen::Vector3d& point, const freespace::FieldScope&) const override
  {
    return point.norm() > 1.0;
  }
};

}

int main()
{
  const Eigen::AlignedBox3d bounds(Eigen::Vector3d::Constant(-1.5), Eigen::Vector3d::Constant(1.5));
  freespace::ContourOptions options;
  options.cells = 16;
  const freespace::ContourMesh mesh = freespace::BisectionContour(Ball(), bounds, options);
  // Euler's formula of a closed surface without handles.
  return 2 * mesh.points.size() == mesh.triangles.size() + 4 ? 0 : 1;
}
