// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCalibratedCamera.h"

#include "Common/Camera.h"
#include "Common/View.h"
#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace freespace;

namespace
{

using RowMajor3x3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor3x4 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

struct CameraArrays
{
  RowMajor3x3 intrinsics;
  RowMajor3x4 pose;
  int size[2];

  explicit CameraArrays(const Camera& camera)
    : intrinsics(camera.K)
    , size{ camera.width, camera.height }
  {
    this->pose << camera.R, camera.t;
  }

  int Apply(vtkCamera* target) const
  {
    return vtkCalibratedCamera::Apply(
      target, this->intrinsics.data(), this->pose.data(), this->size);
  }
};

Camera RandomCamera(std::mt19937& random, bool plain)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Camera camera;
  camera.width = 320 + static_cast<int>(60 * unit(random));
  camera.height = 240 + static_cast<int>(60 * unit(random));
  const double focal = 400 + 150 * unit(random);
  camera.K << focal, 0, camera.width / 2.0 + 70 * unit(random), 0, focal,
    camera.height / 2.0 + 70 * unit(random), 0, 0, 1;
  if (!plain)
  {
    camera.K(1, 1) *= 1 + 0.3 * unit(random);
    camera.K(0, 1) = 20 * unit(random);
  }
  const Eigen::Vector3d axis(unit(random), unit(random), unit(random));
  camera.R = Eigen::AngleAxisd(3.0 * unit(random), axis.normalized()).matrix();
  camera.t = Eigen::Vector3d(unit(random), unit(random), unit(random)) * 5;
  return camera;
}

// A disc at a pixel, parallel to the image: its image is an ellipse around that pixel.
vtkSmartPointer<vtkPolyData> Disc(
  const Camera& camera, const Eigen::Vector2d& pixel, double depth, double radius)
{
  const int sides = 64;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  auto disc = vtkSmartPointer<vtkPolyData>::New();
  disc->AllocateExact(1, sides);
  std::vector<vtkIdType> ids;
  for (int i = 0; i < sides; ++i)
  {
    const double angle = 2 * M_PI * i / sides;
    const Eigen::Vector2d rim = pixel + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    ids.push_back(points->InsertNextPoint(camera.Unproject(rim, depth).data()));
  }
  disc->SetPoints(points);
  disc->InsertNextCell(VTK_POLYGON, sides, ids.data());
  return disc;
}

struct Scene
{
  Camera camera;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;

  explicit Scene(const Camera& seenBy)
    : camera(seenBy)
  {
    this->window->SetOffScreenRendering(1);
    this->window->SetMultiSamples(0);
    this->window->SetSize(camera.width, camera.height);
    this->window->AddRenderer(this->renderer);
  }

  void AddDisc(const Eigen::Vector2d& pixel, double depth, double radius, int red)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(Disc(this->camera, pixel, depth, radius));
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(red / 255.0, 0.0, 0.0);
    this->renderer->AddActor(actor);
  }

  void Render()
  {
    ASSERT_EQ(CameraArrays(this->camera).Apply(this->renderer->GetActiveCamera()), 1);
    this->renderer->ResetCameraClippingRange();
    this->window->Render();
    this->window->GetPixelData(
      0, 0, this->camera.width - 1, this->camera.height - 1, 1, this->Pixels);
  }

  int Red(int column, int row) const // row 0 at the top
  {
    const vtkIdType at = vtkIdType(this->camera.height - 1 - row) * this->camera.width + column;
    return this->Pixels->GetPointer(3 * at)[0];
  }

  // The mean pixel, in the convention of the camera, of all pixels of that red.
  Eigen::Vector2d Centroid(int red) const
  {
    Eigen::Vector2d sum(0, 0);
    int count = 0;
    for (int row = 0; row < this->camera.height; ++row)
    {
      for (int column = 0; column < this->camera.width; ++column)
      {
        if (this->Red(column, row) == red)
        {
          sum += Eigen::Vector2d(column + 0.5, row + 0.5);
          ++count;
        }
      }
    }
    return sum / count;
  }

  double Depth(int column, int row)
  {
    const double z = this->renderer->GetZ(column, this->camera.height - 1 - row);
    double range[2];
    this->renderer->GetActiveCamera()->GetClippingRange(range);
    return range[0] * range[1] / (range[1] - z * (range[1] - range[0]));
  }

  vtkNew<vtkUnsignedCharArray> Pixels;
};

void ExpectAgreement(bool plain)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Eigen::Vector2d bias(0, 0);
  int count = 0;
  for (int repeat = 0; repeat < 8; ++repeat)
  {
    Scene scene(RandomCamera(random, plain));
    std::vector<Eigen::Vector3d> centers;
    for (int i = 0; i < 9; ++i) // one disc in each of 3 x 3 fields, so that none hides another
    {
      const Eigen::Vector2d pixel((i % 3 + 0.3 + 0.4 * unit(random)) * scene.camera.width / 3,
        (i / 3 + 0.3 + 0.4 * unit(random)) * scene.camera.height / 3);
      const double depth = 1.0 + 9.0 * unit(random);
      centers.push_back(scene.camera.Unproject(pixel, depth));
      scene.AddDisc(pixel, depth, 9.0 + unit(random), 20 * (i + 1));
    }
    scene.Render();
    for (int i = 0; i < 9; ++i)
    {
      const Eigen::Vector2d expected = scene.camera.Project(centers[i]);
      const Eigen::Vector2d error = scene.Centroid(20 * (i + 1)) - expected;
      EXPECT_LT(error.norm(), 0.2) << "disc " << i << " of camera " << repeat;
      bias += error;
      ++count;
      const double depth = scene.camera.Depth(centers[i]);
      EXPECT_NEAR(scene.Depth(static_cast<int>(expected.x()), static_cast<int>(expected.y())),
        depth, 1e-4 * depth);
    }
  }
  EXPECT_LT((bias / count).norm(), 0.02) << "a systematic shift: a wrong pixel convention?";
}

}

TEST(CalibratedCamera, SeesPointsWhereTheCameraProjectsThem)
{
  ExpectAgreement(true);
}

TEST(CalibratedCamera, KeepsUnequalFocalLengthsAndSkew)
{
  ExpectAgreement(false);
}

TEST(CalibratedCamera, NearHidesFar)
{
  std::mt19937 random(3);
  Scene scene(RandomCamera(random, false));
  const Eigen::Vector2d pixel(scene.camera.width / 3.0, scene.camera.height / 2.0);
  scene.AddDisc(pixel, 2.00, 6.0, 200);
  scene.AddDisc(pixel, 2.01, 20.0, 100);
  scene.Render();
  const int column = static_cast<int>(pixel.x());
  const int row = static_cast<int>(pixel.y());
  EXPECT_EQ(scene.Red(column, row), 200);
  EXPECT_EQ(scene.Red(column + 12, row), 100);
  EXPECT_EQ(scene.Red(column + 24, row), 0);
}

TEST(CalibratedCamera, ReadsTheFieldDataOfAView)
{
  std::mt19937 random(5);
  View view;
  view.camera = RandomCamera(random, false);
  vtkNew<vtkCamera> fromBlock;
  vtkNew<vtkCamera> fromArrays;
  ASSERT_EQ(vtkCalibratedCamera::ApplyViewBlock(fromBlock, BlockFromView(view)), 1);
  ASSERT_EQ(CameraArrays(view.camera).Apply(fromArrays), 1);
  const double aspect = double(view.camera.width) / view.camera.height;
  vtkMatrix4x4* a = fromBlock->GetCompositeProjectionTransformMatrix(aspect, -1, 1);
  vtkMatrix4x4* b = fromArrays->GetCompositeProjectionTransformMatrix(aspect, -1, 1);
  for (int i = 0; i < 16; ++i)
  {
    EXPECT_EQ(a->GetElement(i / 4, i % 4), b->GetElement(i / 4, i % 4));
  }
}

TEST(CalibratedCamera, RefusesWhatIsNoCamera)
{
  ExpectedErrors errors;
  std::mt19937 random(5);
  vtkNew<vtkCamera> target;
  const vtkMTimeType before = target->GetMTime();
  const Camera good = RandomCamera(random, true);
  Camera camera = good;
  camera.t.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CameraArrays(camera).Apply(target), 0);
  EXPECT_TRUE(errors.Has("a value that is not finite"));
  camera = good;
  camera.R *= 1.01;
  EXPECT_EQ(CameraArrays(camera).Apply(target), 0);
  EXPECT_TRUE(errors.Has("a matrix that is no rotation"));
  camera = good;
  camera.R.row(0) *= -1; // a mirror
  EXPECT_EQ(CameraArrays(camera).Apply(target), 0);
  EXPECT_TRUE(errors.Has("a matrix that is no rotation"));
  camera = good;
  camera.K(0, 0) = 0;
  EXPECT_EQ(CameraArrays(camera).Apply(target), 0);
  EXPECT_TRUE(errors.Has("positive focal lengths"));
  camera = good;
  camera.width = 0;
  EXPECT_EQ(CameraArrays(camera).Apply(target), 0);
  EXPECT_TRUE(errors.Has("has no pixels"));
  vtkNew<vtkPolyData> noView;
  EXPECT_EQ(vtkCalibratedCamera::ApplyViewBlock(target, noView), 0);
  EXPECT_TRUE(errors.Has("no array CameraIntrinsics"));
  EXPECT_EQ(target->GetMTime(), before);
}
