// SPDX-License-Identifier: BSD-3-Clause
#include "Export/CameraFrusta.h"

#include "Support/Scenes/BlockFeatures.h"
#include "Support/PictureComparison.h"
#include "vtkSurfacePicture.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

TEST(CameraFrusta, ArePyramidsAboutTheScene)
{
  const BlockScene scene;
  std::vector<Camera> cameras;
  for (int i = 0; i < BlockCameras; ++i)
  {
    cameras.push_back(scene.CameraAt(2 * M_PI * i / BlockCameras));
  }
  // Each is as far from the next as from the axis: 9.
  EXPECT_NEAR(FrustumDepth(cameras), 3, 1e-9);
  const TriangleMesh frusta = CameraFrusta(cameras, 3);
  ASSERT_EQ(frusta.points.size(), 36u);
  ASSERT_EQ(frusta.triangles.size(), 30u);
  for (int i = 0; i < BlockCameras; ++i)
  {
    const Camera& camera = cameras[i];
    EXPECT_LT((frusta.points[6 * i] - camera.Center()).norm(), 1e-9);
    const Eigen::Vector2d corners[4] = { { 0, 0 }, { camera.width, 0 },
      { camera.width, camera.height }, { 0, camera.height } };
    for (int corner = 0; corner < 4; ++corner)
    {
      const Eigen::Vector3d& point = frusta.points[6 * i + 1 + corner];
      EXPECT_NEAR(camera.Depth(point), 3, 1e-9);
      EXPECT_LT((camera.Project(point) - corners[corner]).norm(), 1e-6) << i << " " << corner;
    }
    const Eigen::Vector2d above = camera.Project(frusta.points[6 * i + 5]);
    EXPECT_NEAR(above.x(), camera.width / 2.0, 1e-6);
    EXPECT_LT(above.y(), 0) << "over the upper edge";
  }
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (const Eigen::Vector3d& point : frusta.points)
  {
    points->InsertNextPoint(point.data());
  }
  for (const auto& triangle : frusta.triangles)
  {
    triangles->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(surface);
  picture->SetSize(160, 120);
  picture->Update();
  ExpectBaseline(picture->GetOutput(), "CameraFrusta");
}
