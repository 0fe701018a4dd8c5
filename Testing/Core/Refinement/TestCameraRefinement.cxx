// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/CameraRefinement.h"

#include "Common/Error.h"
#include "Refinement/RefinementClusters.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <random>
#include <thread>

using namespace freespace;

namespace
{

// Two slanted planes of coloured squares, photographed by a cross of cameras, on disk.
class PlanesScene
{
public:
  PlanesScene()
    : Cameras(CrossOfCameras())
  {
    Layer back, front;
    back.depth = 1.1;
    back.exists = Everywhere();
    back.color = RandomSquares(0.05, 5);
    front.depth = 0.9;
    front.slope = { 0.3, 0.1 };
    front.exists = [](double x, double) { return x > 0; };
    front.color = RandomSquares(0.04, 9);
    const char* names[5] = { "c.png", "l.png", "r.png", "u.png", "d.png" };
    std::filesystem::create_directories(this->Folder.Path("images"));
    SparseCamera lens;
    lens.id = 1;
    const Camera& first = this->Cameras[0];
    lens.width = first.width;
    lens.height = first.height;
    lens.parameters = { first.K(0, 0), first.K(1, 1), first.K(0, 2), first.K(1, 2) };
    this->Exact.cameras.push_back(lens);
    for (std::uint32_t i = 0; i < 5; ++i)
    {
      cv::imwrite(this->Folder.Path("images/" + std::string(names[i])),
        Render({ back, front }, this->Cameras[i], nullptr, 12));
      SparseImage image;
      image.id = i + 1;
      image.name = names[i];
      image.camera = 1;
      const Eigen::Quaterniond q(this->Cameras[i].R);
      image.rotation = { q.w(), q.x(), q.y(), q.z() };
      image.translation = this->Cameras[i].t;
      this->Exact.images.push_back(image);
    }
    this->Scene.file = this->Folder.Path("scene.json");
    this->Scene.images = "images";
  }

  CameraRefinement Refine(
    const SparseModel& model, const ParallelFor& parallelFor = SerialFor) const
  {
    EdgeStore edges(this->Scene, EdgeTokenOptions());
    return RefineCameras(this->Scene, model, edges, MatcherOptions(), CameraRefinementOptions(),
      parallelFor, Progress());
  }

  // The model with its cameras turned, so that the images move by about so many pixels.
  SparseModel Perturbed(double pixels) const
  {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, pixels / 400);
    SparseModel model = this->Exact;
    for (SparseImage& image : model.images)
    {
      const Eigen::Vector3d turn(normal(random), normal(random), normal(random));
      const Eigen::Quaterniond r(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      const auto& [w, x, y, z] = image.rotation;
      const Eigen::Quaterniond q = r * Eigen::Quaterniond(w, x, y, z);
      image.rotation = { q.w(), q.x(), q.y(), q.z() };
      image.translation = r * image.translation;
    }
    return model;
  }

  TemporaryFolder Folder;
  std::vector<Camera> Cameras;
  freespace::Scene Scene;
  SparseModel Exact;
};

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

TEST(RefinementClusters, TakeTheNamedClustersImagesAlone)
{
  PlanesScene scene;
  scene.Scene.clusters.push_back({ "row", "c.png", { { "l.png", "c.png", "r.png" } } });
  const auto clusters = ClustersForRefinement(scene.Scene, scene.Exact, 4);
  ASSERT_EQ(clusters.size(), 3u);
  for (const Cluster& cluster : clusters)
  {
    ASSERT_EQ(cluster.triplets.size(), 1u);
    EXPECT_EQ(cluster.triplets[0][1], cluster.reference);
    EXPECT_NE(cluster.reference, "u.png");
  }
}
