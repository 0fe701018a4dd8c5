// SPDX-License-Identifier: BSD-3-Clause
#include "LookAt.h"
#include "NovelCameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace freespace;

namespace
{

constexpr double degree = M_PI / 180;

Camera On(double azimuth, double elevation, double distance, const Eigen::Vector3d& middle)
{
  Camera like;
  like.K << 800, 0, 320, 0, 800, 240, 0, 0, 1;
  like.width = 640;
  like.height = 480;
  const Eigen::Vector3d from(std::cos(azimuth) * std::cos(elevation),
    std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
  return LookAt(like, middle + distance * from, middle, Eigen::Vector3d::UnitZ());
}

double AngleAbout(const Camera& a, const Camera& b, const Eigen::Vector3d& middle)
{
  return std::acos((a.Center() - middle).normalized().dot((b.Center() - middle).normalized()));
}

}

TEST(LookAt, PutsTheMiddleInTheMiddleAndKeepsTheHorizon)
{
  const Eigen::Vector3d middle(1, 2, 3);
  const Camera camera = On(0.7, 0.4, 5, middle);
  EXPECT_TRUE(camera.Project(middle).isApprox(Eigen::Vector2d(320, 240), 1e-12));
  EXPECT_NEAR(camera.Depth(middle), 5, 1e-12);
  EXPECT_NEAR((camera.R * camera.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_NEAR(camera.R.determinant(), 1, 1e-12);
  EXPECT_NEAR(camera.R(0, 2), 0, 1e-12) << "right is level";
  EXPECT_LT(camera.Project(middle + Eigen::Vector3d::UnitZ() * 0.1).y(), 240) << "up is up";
}

TEST(MeanUp, IsThatOfTheCamerasOrNothing)
{
  EXPECT_TRUE(MeanUp({}).isZero());
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  EXPECT_TRUE(MeanUp({ On(0, 0.5, 1, origin), On(M_PI, 0.5, 1, origin) })
                .isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  Camera upsideDown = On(0, 0, 1, origin);
  upsideDown.R.topRows<2>() *= -1;
  EXPECT_TRUE(MeanUp({ On(0, 0, 1, origin), upsideDown }).isZero());
}

TEST(NovelCameras, AreHalfwayOnARing)
{
  const Eigen::Vector3d middle(0.2, -0.1, 0.3);
  std::vector<Camera> ring;
  for (int i = 0; i < 6; ++i)
  {
    ring.push_back(On(i * 60 * degree, 30 * degree, 2, middle));
  }
  const std::vector<Camera> novel = NovelCameras(ring, middle, 3);
  ASSERT_EQ(novel.size(), 3u);
  for (const Camera& camera : novel)
  {
    EXPECT_NEAR((camera.Center() - middle).norm(), 2, 1e-9);
    EXPECT_TRUE(camera.Project(middle).isApprox(Eigen::Vector2d(320, 240), 1e-9));
    double nearest = M_PI;
    for (const Camera& known : ring)
    {
      nearest = std::min(nearest, AngleAbout(camera, known, middle));
    }
    // Half of the angle between neighbours, whose chord is 2 cos(30) sin(30).
    EXPECT_NEAR(nearest, std::asin(std::cos(30 * degree) * std::sin(30 * degree)), 1e-9);
  }
  EXPECT_GT(AngleAbout(novel[0], novel[1], middle), 90 * degree) << "far apart";
}

TEST(NovelCameras, StepAsideFromASingleOne)
{
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const Camera only = On(0.3, 0.5, 2, middle);
  const std::vector<Camera> novel = NovelCameras({ only, only }, middle, 2);
  ASSERT_EQ(novel.size(), 1u) << "one place, not the same twice";
  EXPECT_NEAR((novel[0].Center() - middle).norm(), 2, 1e-12);
  EXPECT_NEAR(AngleAbout(novel[0], only, middle), 15 * degree, 1e-9);
}

TEST(NovelCameras, StayFiniteAlongAFilm)
{
  // As in a film, each picture is a degree beside the last.
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<Camera> film;
  for (int i = 0; i < 40; ++i)
  {
    film.push_back(On(i * degree, 0.2, 1, middle));
  }
  for (const Camera& camera : NovelCameras(film, middle, 2))
  {
    EXPECT_TRUE(camera.R.allFinite() && camera.t.allFinite());
  }
}

TEST(NovelCameras, StraightFromAbove)
{
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Camera above;
  above.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
  above.t = Eigen::Vector3d(0, 0, 2);
  const std::vector<Camera> novel = NovelCameras({ above }, middle, 1);
  ASSERT_EQ(novel.size(), 1u);
  EXPECT_TRUE(novel[0].R.allFinite());
  EXPECT_NEAR(novel[0].Depth(middle), 2, 1e-12);
}

TEST(NovelCameras, NoneWithoutCameras)
{
  EXPECT_TRUE(NovelCameras({}, Eigen::Vector3d::Zero(), 2).empty());
  EXPECT_TRUE(NovelCameras({ Camera() }, Eigen::Vector3d::Zero(), 2).empty())
    << "a camera in the middle looks nowhere";
}

TEST(MedianPoint, HeedsNoOutlier)
{
  EXPECT_TRUE(MedianPoint({}).isZero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
    MedianPoint({ { 1, 2, 3 }, { 2, 3, 4 }, { 3, 4, 5 }, { 1e9, -1e9, 4 }, { nan, 3, 4 } })
      .isApprox(Eigen::Vector3d(3, 3, 4)));
}
