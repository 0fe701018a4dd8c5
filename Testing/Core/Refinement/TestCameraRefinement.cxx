// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/CameraRefinement.h"

#include "Support/Scenes/PlanesScene.h"

#include <gtest/gtest.h>

#include <thread>

using namespace freespace;

namespace
{

// As many threads as bodies, in whatever order.
void ThreadsFor(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::vector<std::thread> threads;
  for (std::size_t i = count; i-- > 0;)
  {
    threads.emplace_back([&body, i]() { body(i, i + 1); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

}

TEST(CameraRefinement, BringsPerturbedCamerasBack)
{
  const PlanesScene scene;
  const CameraRefinement refined = scene.Refine(scene.Perturbed(0.5));
  EXPECT_TRUE(refined.isRefined);
  EXPECT_EQ(refined.clusters, 5u);
  EXPECT_GT(refined.tracks, 300u);
  EXPECT_LT(refined.residuals.residualAfter, 0.5 * refined.residuals.residualBefore);
}

TEST(CameraRefinement, LeavesExactCamerasAsTheyAre)
{
  const PlanesScene scene;
  const CameraRefinement refined = scene.Refine(scene.Exact);
  EXPECT_FALSE(refined.isRefined);
  const auto given = CalibratedImages(scene.Exact);
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    EXPECT_EQ(refined.images[i].camera.R, given[i].camera.R);
    EXPECT_EQ(refined.images[i].camera.t, given[i].camera.t);
  }
}

TEST(CameraRefinement, IsTheSameForAnyNumberOfThreads)
{
  const PlanesScene scene;
  const SparseModel model = scene.Perturbed(0.5);
  const CameraRefinement one = scene.Refine(model), many = scene.Refine(model, ThreadsFor);
  for (std::size_t i = 0; i < one.images.size(); ++i)
  {
    EXPECT_EQ(one.images[i].camera.R, many.images[i].camera.R);
    EXPECT_EQ(one.images[i].camera.t, many.images[i].camera.t);
  }
}

TEST(CameraRefinement, NothingToMatch)
{
  const PlanesScene scene;
  SparseModel two = scene.Exact;
  two.images.resize(2);
  const CameraRefinement refined = scene.Refine(two);
  EXPECT_FALSE(refined.isRefined);
  EXPECT_EQ(refined.clusters, 0u);
  EXPECT_EQ(refined.images.size(), 2u);
}

TEST(CameraRefinement, WritesTheCamerasIntoTheModel)
{
  const PlanesScene scene;
  auto images = CalibratedImages(scene.Exact);
  images[1].camera.t += Eigen::Vector3d(1, 2, 3);
  for (CalibratedImage& image : images)
  {
    image.camera.K.topLeftCorner<2, 2>() *= 2;
  }
  const auto again = CalibratedImages(WithCameras(scene.Exact, images));
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    EXPECT_LT((again[i].camera.R - images[i].camera.R).norm(), 1e-12);
    EXPECT_EQ(again[i].camera.t, images[i].camera.t);
    EXPECT_EQ(again[i].camera.K, images[i].camera.K);
  }
}
