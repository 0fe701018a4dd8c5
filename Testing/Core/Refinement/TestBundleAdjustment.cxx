// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/BundleAdjustment.h"

#include "Common/Error.h"
#include "Support/SyntheticImages.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace freespace;

namespace
{

// Edges of every direction in a box, seen by an arc of cameras around it.
struct EdgeScene
{
  explicit EdgeScene(double noise, int count = 600)
  {
    for (int i = 0; i < 6; ++i)
    {
      const double angle = 0.15 * (i - 2.5);
      this->Cameras.push_back(
        LookAt({ std::sin(angle), 0.05 * (i % 3), 1 - std::cos(angle) }, { 0, 0, 1 }));
    }
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> box(-0.2, 0.2);
    for (int k = 0; k < count; ++k)
    {
      const Eigen::Vector3d point(box(this->Random), box(this->Random), 1 + box(this->Random));
      const Eigen::Vector3d along =
        Eigen::Vector3d(normal(this->Random), normal(this->Random), normal(this->Random))
          .normalized();
      EdgeTrack& track = this->Tracks.emplace_back();
      track.point = point;
      for (int i = 0; i < 4; ++i)
      {
        const int camera = (k + i) % 6;
        const Eigen::Vector2d pixel = this->Cameras[camera].Project(point);
        const Eigen::Vector2d tangent =
          (this->Cameras[camera].Project(point + 1e-4 * along) - pixel).normalized();
        const Eigen::Vector2d across(-tangent.y(), tangent.x());
        // Somewhere along the edge: only the distance across it tells.
        const double slide = i == 0 ? 0 : 0.5 * normal(this->Random);
        track.observations.push_back(
          { camera, pixel + noise * normal(this->Random) * across + slide * tangent, across, 1 });
      }
      this->Points.push_back(point);
    }
  }

  // Cameras turned and moved such that the images move by about so many pixels.
  std::vector<Camera> Perturbed(double pixels)
  {
    std::normal_distribution<double> normal(0, pixels / 400);
    std::vector<Camera> cameras = this->Cameras;
    for (Camera& camera : cameras)
    {
      const Eigen::Vector3d turn(normal(this->Random), normal(this->Random), normal(this->Random));
      const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
      camera.R = R * camera.R;
      camera.t = R * camera.t +
        Eigen::Vector3d(normal(this->Random), normal(this->Random), normal(this->Random));
    }
    return cameras;
  }

  // Mean distance of the true points' images from the true ones, after the similarity that lays the
  // tracks' points over them.
  double Error(const std::vector<Camera>& cameras, const std::vector<EdgeTrack>& tracks) const
  {
    Eigen::Matrix3Xd from(3, tracks.size()), to(3, tracks.size());
    for (std::size_t k = 0; k < tracks.size(); ++k)
    {
      to.col(k) = tracks[k].point;
      from.col(k) = this->Points[k];
    }
    const Eigen::Affine3d fit(Eigen::umeyama(from, to));
    double sum = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i)
    {
      for (const Eigen::Vector3d& point : this->Points)
      {
        sum += (cameras[i].Project(fit * point) - this->Cameras[i].Project(point)).norm();
      }
    }
    return sum / (cameras.size() * this->Points.size());
  }

  std::mt19937 Random{ 7 };
  std::vector<Camera> Cameras;
  std::vector<EdgeTrack> Tracks;
  std::vector<Eigen::Vector3d> Points;
};

const std::vector<int> OneLens(6, 0);

}

TEST(BundleAdjustment, RecoversPerturbedCameras)
{
  EdgeScene scene(0.05);
  const std::vector<Camera> given = scene.Perturbed(0.5);
  std::vector<Camera> cameras = given;
  std::vector<EdgeTrack> tracks = scene.Tracks;
  EXPECT_GT(scene.Error(cameras, tracks), 0.4);
  const auto summary = AdjustCameras(given, cameras, OneLens, tracks, {});
  EXPECT_LT(scene.Error(cameras, tracks), 0.06);
  EXPECT_LT(summary.residualAfter, 0.04);
  EXPECT_GT(summary.residualBefore, 2 * summary.residualAfter);
}

TEST(BundleAdjustment, IgnoresWrongMatches)
{
  EdgeScene scene(0.05);
  std::uniform_real_distribution<double> off(1, 10);
  for (std::size_t k = 0; k < scene.Tracks.size(); k += 8)
  {
    EdgeObservation& wrong = scene.Tracks[k].observations[2];
    wrong.position += off(scene.Random) * wrong.normal;
  }
  const std::vector<Camera> given = scene.Perturbed(0.4);
  std::vector<Camera> cameras = given;
  AdjustCameras(given, cameras, OneLens, scene.Tracks, {});
  // The wrong tracks' points are wrong: the frame is that of the others.
  std::vector<EdgeTrack> right;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < scene.Tracks.size(); ++k)
  {
    if (k % 8 != 0)
    {
      right.push_back(scene.Tracks[k]);
      points.push_back(scene.Points[k]);
    }
  }
  scene.Points = points;
  EXPECT_LT(scene.Error(cameras, right), 0.06);
}

TEST(BundleAdjustment, LeavesExactCamerasAlone)
{
  EdgeScene scene(0);
  std::vector<Camera> cameras = scene.Cameras;
  AdjustCameras(scene.Cameras, cameras, OneLens, scene.Tracks, {});
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    EXPECT_LT((cameras[i].R - scene.Cameras[i].R).norm(), 1e-7);
    EXPECT_LT((cameras[i].t - scene.Cameras[i].t).norm(), 1e-7);
  }
}

TEST(BundleAdjustment, StaysInTheGivenFrame)
{
  EdgeScene scene(0.05);
  const std::vector<Camera> given = scene.Perturbed(0.3);
  std::vector<Camera> cameras = given;
  AdjustCameras(given, cameras, OneLens, scene.Tracks, {});
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    EXPECT_LT((cameras[i].Center() - given[i].Center()).norm(), 0.01);
  }
}

TEST(BundleAdjustment, FindsTheFocalLengthWhereAsked)
{
  EdgeScene scene(0.02);
  std::vector<Camera> given = scene.Cameras;
  for (Camera& camera : given)
  {
    camera.K.topLeftCorner<2, 2>() *= 1.004;
  }
  BundleAdjustmentOptions options;
  options.iterations = 40;
  options.focalLengthDeviation = 0.01;
  std::vector<Camera> kept = given, refined = given;
  std::vector<EdgeTrack> tracks = scene.Tracks;
  AdjustCameras(given, kept, OneLens, tracks, options);
  EXPECT_EQ(kept[0].K, given[0].K);
  options.refineFocalLengths = true;
  AdjustCameras(given, refined, OneLens, scene.Tracks, options);
  EXPECT_NEAR(refined[0].K(0, 0), 400, 0.6);
  EXPECT_EQ(refined[5].K, refined[0].K);
}

TEST(BundleAdjustment, ACameraWithoutTracksStays)
{
  EdgeScene scene(0.05);
  const std::vector<Camera> given = scene.Perturbed(0.3);
  for (EdgeTrack& track : scene.Tracks)
  {
    auto& observations = track.observations;
    observations.erase(std::remove_if(observations.begin(), observations.end(),
                         [](const EdgeObservation& o) { return o.image == 3; }),
      observations.end());
  }
  std::vector<Camera> cameras = given;
  AdjustCameras(given, cameras, OneLens, scene.Tracks, {});
  EXPECT_EQ(cameras[3].R, given[3].R);
  EXPECT_EQ(cameras[3].t, given[3].t);
  EXPECT_NE(cameras[2].R, given[2].R);
}

TEST(BundleAdjustment, NoTracks)
{
  EdgeScene scene(0);
  std::vector<Camera> cameras = scene.Cameras;
  std::vector<EdgeTrack> none;
  const auto summary = AdjustCameras(scene.Cameras, cameras, OneLens, none, {});
  EXPECT_EQ(summary.residualAfter, 0);
  EXPECT_EQ(cameras[0].R, scene.Cameras[0].R);
}

TEST(BundleAdjustment, RefusesWrongOptions)
{
  BundleAdjustmentOptions options;
  options.poseDeviation = 0;
  EXPECT_THROW(options.Check(), Error);
  options = {};
  options.iterations = 1;
  EXPECT_THROW(options.Check(), Error);
  options = {};
  options.focalLengthDeviation = -1;
  EXPECT_THROW(options.Check(), Error);
}
