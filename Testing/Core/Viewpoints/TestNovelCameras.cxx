// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/NovelCameras.h"

#include "Support/Core/PlaceAround.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace freespace;

namespace
{

constexpr double degree = M_PI / 180;

double AngleBetween(const Camera& a, const Camera& b)
{
  const Eigen::Vector3d first = a.R.row(2);
  const Eigen::Vector3d second = b.R.row(2);
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

// A view with features on a small sphere around the middle.
View Seeing(const Camera& camera, const Eigen::Vector3d& middle)
{
  View view;
  view.camera = camera;
  for (int i = 0; i < 200; ++i)
  {
    const double z = 1 - (2 * i + 1) / 200.0;
    const double angle = 2.4 * i;
    view.points.push_back(middle +
      0.3 *
        Eigen::Vector3d(
          std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z));
  }
  return view;
}

}

TEST(NovelCameras, AreBesideTheCamerasOfARingAndHoldAllFeatures)
{
  const Eigen::Vector3d middle(0.2, -0.1, 0.3);
  std::vector<View> ring;
  for (int i = 0; i < 6; ++i)
  {
    ring.push_back(Seeing(PlaceAround(i * 60 * degree, 30 * degree, 2, middle), middle));
  }
  const std::vector<Camera> novel = NovelCameras(ring, 3);
  ASSERT_EQ(novel.size(), 3u);
  for (const Camera& camera : novel)
  {
    double nearest = M_PI;
    for (const View& known : ring)
    {
      nearest = std::min(nearest, AngleBetween(camera, known.camera));
    }
    EXPECT_NEAR(nearest, 15 * degree, 1e-6);
    EXPECT_NEAR(camera.R(0, 2), 0, 1e-6) << "right is level";
    EXPECT_LT(camera.R(1, 2), 0) << "up is up";
    for (const Eigen::Vector3d& point : ring[0].points)
    {
      EXPECT_TRUE(camera.Depth(point) > 0 && camera.Sees(camera.Project(point)));
    }
  }
  EXPECT_GT(AngleBetween(novel[0], novel[1]), 90 * degree) << "far apart";
}

TEST(NovelCameras, BeginBesideTheViewThatSeesMost)
{
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  View poor = Seeing(PlaceAround(0, 0.4, 2, middle), middle);
  poor.points.resize(poor.points.size() / 2);
  const View good = Seeing(PlaceAround(90 * degree, 0.4, 2, middle), middle);
  const std::vector<Camera> novel = NovelCameras({ poor, good }, 1);
  ASSERT_EQ(novel.size(), 1u);
  EXPECT_NEAR(AngleBetween(novel[0], good.camera), 15 * degree, 1e-6);
}

TEST(NovelCameras, AreHalfwayBetweenNearNeighbours)
{
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const View a = Seeing(PlaceAround(0, 0, 2, middle), middle);
  const View b = Seeing(PlaceAround(20 * degree, 0, 2, middle), middle);
  const std::vector<Camera> novel = NovelCameras({ a, b }, 1);
  ASSERT_EQ(novel.size(), 1u);
  EXPECT_NEAR(AngleBetween(novel[0], a.camera), 10 * degree, 1e-6);
  EXPECT_NEAR(AngleBetween(novel[0], b.camera), 10 * degree, 1e-6);
}

TEST(NovelCameras, StepAsideFromASingleOne)
{
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const View only = Seeing(PlaceAround(0.3, 0.5, 2, middle), middle);
  const std::vector<Camera> novel = NovelCameras({ only, only }, 2);
  ASSERT_EQ(novel.size(), 1u) << "one place, not the same twice";
  EXPECT_NEAR(AngleBetween(novel[0], only.camera), 15 * degree, 1e-9);
}

TEST(NovelCameras, StayFiniteAlongAFilm)
{
  // As in a film, each picture is a degree beside the last.
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<View> film;
  for (int i = 0; i < 40; ++i)
  {
    film.push_back(Seeing(PlaceAround(i * degree, 0.2, 1, middle), middle));
  }
  for (const Camera& camera : NovelCameras(film, 2))
  {
    EXPECT_TRUE(camera.R.allFinite() && camera.t.allFinite());
  }
}

TEST(NovelCameras, StraightFromAbove)
{
  View above;
  above.camera = PlaceAround(0, 0, 1, Eigen::Vector3d::Zero());
  above.camera.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
  above.camera.t = Eigen::Vector3d(0, 0, 2);
  const std::vector<Camera> novel =
    NovelCameras({ Seeing(above.camera, Eigen::Vector3d::Zero()) }, 1);
  ASSERT_EQ(novel.size(), 1u);
  EXPECT_TRUE(novel[0].R.allFinite());
  EXPECT_NEAR(AngleBetween(novel[0], above.camera), 15 * degree, 1e-9);
  EXPECT_GT(novel[0].Depth(Eigen::Vector3d::Zero()), 0);
}

TEST(NovelCameras, DoNotLookFromBehind)
{
  // Cameras on one side of a wall, whose features the novel camera must see from that side.
  std::vector<View> views;
  for (int i = -2; i <= 2; ++i)
  {
    Camera camera = PlaceAround(0, 0, 4, Eigen::Vector3d(0, i, 0));
    View view;
    view.camera = camera;
    for (int k = 0; k < 100; ++k)
    {
      view.points.emplace_back(0, i + 0.01 * k, 0.1 * (k % 7));
    }
    views.push_back(view);
  }
  const std::vector<Camera> novel = NovelCameras(views, 2);
  ASSERT_FALSE(novel.empty());
  for (const Camera& camera : novel)
  {
    EXPECT_GT(camera.Center().x(), 1);
  }
}

TEST(NovelCameras, NoneWithoutFeatures)
{
  EXPECT_TRUE(NovelCameras({}, 2).empty());
  EXPECT_TRUE(NovelCameras({ View() }, 2).empty());
}

TEST(MedianPoint, HeedsNoOutlier)
{
  EXPECT_TRUE(MedianPoint({}).isZero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
    MedianPoint({ { 1, 2, 3 }, { 2, 3, 4 }, { 3, 4, 5 }, { 1e9, -1e9, 4 }, { nan, 3, 4 } })
      .isApprox(Eigen::Vector3d(3, 3, 4)));
}
