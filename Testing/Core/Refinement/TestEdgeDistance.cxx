// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/EdgeDistance.h"

#include "Support/SyntheticImages.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

// A camera, its motion and an edge's point before it.
struct MovedScene
{
  explicit MovedScene(unsigned int seed, double turn)
    : Random(seed)
    , Given(LookAt({ this->Number(0.3), this->Number(0.3), this->Number(0.3) }, { 0, 0, 2 }))
    , Point(this->Number(0.3), this->Number(0.3), 2 + this->Number(0.3))
  {
    const Eigen::Vector3d axis =
      Eigen::Vector3d(this->Number(1), this->Number(1), this->Number(1)).normalized();
    for (int k = 0; k < 3; ++k)
    {
      this->Motion[k] = turn * axis[k];
      this->Motion[3 + k] = this->Number(0.02);
    }
    const double angle = this->Number(3);
    this->Edge.position = { 300 + this->Number(100), 200 + this->Number(100) };
    this->Edge.normal = { std::cos(angle), std::sin(angle) };
  }

  double Number(double most)
  {
    return std::uniform_real_distribution<double>(-most, most)(this->Random);
  }

  // Of the parameters changed by `changes`, in the order of the cost function's.
  Eigen::Vector2d Residuals(const Eigen::Matrix<double, 10, 1>& changes) const
  {
    CameraMotion motion = this->Motion;
    for (int k = 0; k < 6; ++k)
    {
      motion[k] += changes[k];
    }
    const double logFocal = this->LogFocal + changes[6];
    const Eigen::Vector3d point = this->Point + changes.tail<3>();
    MovingCamera camera(this->Given, this->Depth);
    camera.Move(motion, logFocal);
    const EdgeDistance distance(camera, this->Edge, 2, 0.5);
    const double* parameters[] = { motion.data(), &logFocal, point.data() };
    Eigen::Vector2d residuals;
    EXPECT_TRUE(distance.Evaluate(parameters, residuals.data(), nullptr));
    return residuals;
  }

  std::mt19937 Random;
  Camera Given;
  double Depth = 1.7, LogFocal = 0.01;
  Eigen::Vector3d Point;
  CameraMotion Motion{};
  EdgeObservation Edge;
};

}

TEST(EdgeDistance, IsThatOfTheMovedCamerasPixel)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const MovedScene scene(seed, 0.1);
    Camera moved = scene.Given;
    const Eigen::Map<const Eigen::Vector3d> turn(scene.Motion.data());
    const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    moved.R = R * scene.Given.R;
    moved.t =
      R * scene.Given.t + scene.Depth * Eigen::Map<const Eigen::Vector3d>(scene.Motion.data() + 3);
    moved.K.topLeftCorner<2, 2>() *= std::exp(scene.LogFocal);
    const Eigen::Vector2d off = moved.Project(scene.Point) - scene.Edge.position;
    const Eigen::Vector2d residuals = scene.Residuals(Eigen::Matrix<double, 10, 1>::Zero());
    EXPECT_NEAR(residuals[0], 2 * scene.Edge.normal.dot(off), 1e-9);
    EXPECT_NEAR(residuals[1],
      0.5 * (scene.Edge.normal.x() * off.y() - scene.Edge.normal.y() * off.x()), 1e-9);
  }
}

// Rotations by nothing, by less than the series' bound and by much more.
TEST(EdgeDistance, DerivativesAreTheLimitsOfDifferences)
{
  for (const double turn : { 0.0, 5e-5, 0.01, 0.7, 3.0 })
  {
    for (unsigned int seed = 0; seed < 20; ++seed)
    {
      MovedScene scene(seed, turn);
      const Eigen::Matrix3d back =
        Eigen::AngleAxisd(turn, Eigen::Map<const Eigen::Vector3d>(scene.Motion.data()).normalized())
          .toRotationMatrix()
          .transpose();
      scene.Point =
        scene.Given.R.transpose() * (back * Eigen::Vector3d(0.1, -0.2, 2) - scene.Given.t);
      MovingCamera camera(scene.Given, scene.Depth);
      camera.Move(scene.Motion, scene.LogFocal);
      const EdgeDistance distance(camera, scene.Edge, 2, 0.5);
      Eigen::Vector2d residuals, byFocal;
      Eigen::Matrix<double, 2, 6, Eigen::RowMajor> byMotion;
      Eigen::Matrix<double, 2, 3, Eigen::RowMajor> byPoint;
      const double* parameters[] = { scene.Motion.data(), &scene.LogFocal, scene.Point.data() };
      double* jacobians[] = { byMotion.data(), byFocal.data(), byPoint.data() };
      ASSERT_TRUE(distance.Evaluate(parameters, residuals.data(), jacobians));
      Eigen::Matrix<double, 2, 10> derivatives;
      derivatives << byMotion, byFocal, byPoint;
      for (int k = 0; k < 10; ++k)
      {
        constexpr double step = 1e-6;
        const Eigen::Matrix<double, 10, 1> change = step * Eigen::Matrix<double, 10, 1>::Unit(k);
        const Eigen::Vector2d difference =
          (scene.Residuals(change) - scene.Residuals(-change)) / (2 * step);
        EXPECT_LT((derivatives.col(k) - difference).norm(), 1e-6 * (1 + difference.norm()))
          << "turn " << turn << ", seed " << seed << ", parameter " << k;
      }
    }
  }
}

TEST(EdgeDistance, ConstantParametersHaveNoDerivatives)
{
  const MovedScene scene(7, 0.1);
  MovingCamera camera(scene.Given, scene.Depth);
  camera.Move(scene.Motion, scene.LogFocal);
  const EdgeDistance distance(camera, scene.Edge, 2, 0.5);
  Eigen::Vector2d residuals;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> byPoint;
  const double* parameters[] = { scene.Motion.data(), &scene.LogFocal, scene.Point.data() };
  double* jacobians[] = { nullptr, nullptr, byPoint.data() };
  ASSERT_TRUE(distance.Evaluate(parameters, residuals.data(), jacobians));
  EXPECT_TRUE(byPoint.allFinite());
}

TEST(EdgeDistance, FailsForPointsThatAreNotInFront)
{
  MovedScene scene(3, 0);
  const MovingCamera camera(scene.Given, scene.Depth);
  const EdgeDistance distance(camera, scene.Edge, 2, 0.5);
  Eigen::Vector2d residuals;
  for (const double depth : { -1e-3, -1.0 })
  {
    scene.Point = scene.Given.R.transpose() * (Eigen::Vector3d(0.1, 0.1, depth) - scene.Given.t);
    const double* parameters[] = { scene.Motion.data(), &scene.LogFocal, scene.Point.data() };
    EXPECT_FALSE(distance.Evaluate(parameters, residuals.data(), nullptr)) << depth;
  }
}
