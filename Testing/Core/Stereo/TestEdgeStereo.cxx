// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/EdgeStereo.h"

#include "Common/Error.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

// A plane of coloured squares at depth 1, photographed by a cross of cameras, on disk.
class SquaresScene
{
public:
  explicit SquaresScene(const std::vector<double>& distortion = {})
  {
    Layer plane;
    plane.exists = Everywhere();
    plane.color = RandomSquares(0.06, 5);
    const char* names[5] = { "c.png", "l.png", "r.png", "u.png", "d.png" };
    const std::vector<Camera> cameras = CrossOfCameras();
    std::filesystem::create_directories(this->Folder.Path("images"));
    for (int i = 0; i < 5; ++i)
    {
      this->Images.push_back({ names[i], cameras[i], LensKind::Perspective, distortion });
      cv::imwrite(this->Folder.Path("images/" + std::string(names[i])),
        Render({ plane }, cameras[i], Undistorted(cameras[i], distortion), 12));
    }
    this->Scene.file = this->Folder.Path("scene.json");
    this->Scene.images = "images";
    this->Cluster.name = "cross";
    this->Cluster.reference = "c.png";
    this->Cluster.triplets = { { "l.png", "c.png", "r.png" }, { "u.png", "c.png", "d.png" } };
  }

  EdgeView Find(bool hasPatches = false) const
  {
    EdgeStereoOptions options;
    options.patches.isOn = hasPatches;
    return FindFeatures(this->Scene, this->Images, this->Cluster, options);
  }

  // What Find() says is wrong.
  std::string Fault() const
  {
    try
    {
      this->Find();
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  }

  void ExpectOneSentence(const std::string& first, const std::string& second) const
  {
    const std::string fault = this->Fault();
    EXPECT_NE(fault.find(first), std::string::npos) << fault;
    EXPECT_NE(fault.find(second), std::string::npos) << fault;
    EXPECT_EQ(fault.back(), '.');
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }

  TemporaryFolder Folder;
  freespace::Scene Scene;
  freespace::Cluster Cluster;
  std::vector<CalibratedImage> Images;

private:
  static PixelMap Undistorted(const Camera& camera, const std::vector<double>& distortion)
  {
    if (distortion.empty())
    {
      return nullptr;
    }
    return [=](const Eigen::Vector2d& pixel)
    {
      const cv::Matx33d K(
        camera.K(0, 0), 0, camera.K(0, 2), 0, camera.K(1, 1), camera.K(1, 2), 0, 0, 1);
      std::vector<cv::Point2d> ideal;
      cv::undistortPoints(std::vector<cv::Point2d>{ { pixel.x(), pixel.y() } }, ideal, K,
        distortion, cv::noArray(), K,
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9));
      return Eigen::Vector2d(ideal[0].x, ideal[0].y);
    };
  }
};

void ExpectOnThePlane(const EdgeView& view)
{
  EXPECT_GT(view.points.size(), 1500u);
  double sum = 0;
  int close = 0;
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    EXPECT_LT((view.camera.Project(view.points[i]) - view.imagePoints[i]).norm(), 1e-6);
    const double off = 40 * (1 / view.camera.Depth(view.points[i]) - 1); // pixels of one baseline
    sum += off;
    close += std::abs(off) < 0.2;
  }
  EXPECT_LT(std::abs(sum / view.points.size()), 0.02);
  EXPECT_GT(close, 0.97 * view.points.size());
}

}

TEST(EdgeStereo, FeaturesOfACross)
{
  const SquaresScene scene;
  const EdgeView view = scene.Find();
  EXPECT_EQ(view.name, "cross");
  EXPECT_EQ(view.imageFile, "c.png");
  ExpectOnThePlane(view);
}

TEST(EdgeStereo, PatchesFollowTheEdges)
{
  const SquaresScene scene;
  const EdgeView edges = scene.Find(), all = scene.Find(true);
  const std::size_t count = edges.points.size();
  ASSERT_GT(all.points.size(), count);
  EXPECT_EQ(all.colors.size(), all.points.size());
  EXPECT_TRUE(std::equal(edges.points.begin(), edges.points.end(), all.points.begin()));
  EXPECT_EQ(all.chains, edges.chains);
  ExpectOnThePlane(all);
  for (std::size_t i = count; i < all.points.size(); ++i)
  {
    EXPECT_EQ(all.chainIds[i], -1);
    EXPECT_EQ(all.edgeDirections[i], Eigen::Vector3d::Zero());
    EXPECT_GE(all.matchingCosts[i], 0);
    EXPECT_LE(all.matchingCosts[i], 1 - PatchOptions().leastCorrelation);
  }
}

// The deviations tell how large the errors are: two of three are smaller than one, 19 of 20 than two. Squares
// without noise are easier than what the deviations were calibrated on, so that more may be.
TEST(EdgeStereo, DeviationsBoundTheErrors)
{
  const SquaresScene scene;
  const EdgeView view = scene.Find(true);
  ASSERT_EQ(view.deviations.size(), view.points.size());
  int within = 0, withinTwo = 0;
  double typical = 0;
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    ASSERT_GT(view.deviations[i], 0);
    const double error = std::abs(1 / view.camera.Depth(view.points[i]) - 1);
    within += error <= view.deviations[i];
    withinTwo += error <= 2 * view.deviations[i];
    typical += 40 * view.deviations[i]; // pixels of one baseline
  }
  const double count = static_cast<double>(view.points.size());
  EXPECT_GT(within, 0.65 * count);
  EXPECT_GT(withinTwo, 0.9 * count);
  EXPECT_LT(typical / count, 0.3) << "they say nothing";
}

TEST(EdgeStereo, PatchesHeedTheMask)
{
  SquaresScene scene;
  const auto inMiddle = [](const Eigen::Vector2d& pixel)
  { return pixel.x() >= 80 && pixel.x() < 160 && pixel.y() >= 60 && pixel.y() < 120; };
  const auto count = [&]
  {
    const EdgeView view = scene.Find(true);
    return std::count_if(view.imagePoints.begin(), view.imagePoints.end(), inMiddle);
  };
  EXPECT_GT(count(), 0);
  const Camera& camera = scene.Images[0].camera;
  cv::Mat mask(camera.height, camera.width, CV_8U, cv::Scalar(255));
  mask(cv::Rect(80, 60, 80, 60)) = 0;
  std::filesystem::create_directories(scene.Folder.Path("masks"));
  cv::imwrite(scene.Folder.Path("masks/c.png.png"), mask);
  scene.Scene.masks = "masks";
  EXPECT_EQ(count(), 0);
}

TEST(EdgeStereo, ChainsFollowTheEdges)
{
  const EdgeView view = SquaresScene().Find();
  ASSERT_EQ(view.edgeDirections.size(), view.points.size());
  ASSERT_EQ(view.colors.size(), view.points.size());
  std::vector<int> uses(view.points.size(), 0);
  for (std::size_t chain = 0; chain < view.chains.size(); ++chain)
  {
    EXPECT_GE(view.chains[chain].size(), 3u);
    for (int i : view.chains[chain])
    {
      ++uses[i];
      EXPECT_EQ(view.chainIds[i], static_cast<int>(chain));
    }
  }
  EXPECT_EQ(uses, std::vector<int>(view.points.size(), 1));
  int alongAxis = 0; // of the squares
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    const Eigen::Vector3d& direction = view.edgeDirections[i];
    EXPECT_NEAR(direction.norm(), 1, 1e-9);
    alongAxis += std::max(std::abs(direction.x()), std::abs(direction.y())) > 0.97;
    EXPECT_GE(view.matchingCosts[i], 0);
    EXPECT_LE(view.matchingCosts[i], 1);
  }
  EXPECT_GT(alongAxis, 0.85 * view.points.size());
}

TEST(EdgeStereo, LensDistortionIsRemoved)
{
  for (const std::vector<double>& distortion : { std::vector<double>{ -0.12, 0.03, 0, 0 },
         std::vector<double>{ 0.1, -0.05, 0.002, -0.003, 0.01 } })
  {
    ExpectOnThePlane(SquaresScene(distortion).Find());
  }
}

TEST(EdgeStereo, DepthRangeWithoutTheScene)
{
  const SquaresScene scene;
  EdgeStereoOptions options;
  options.matching.minimumDisparity = 1.3;
  EXPECT_THROW(FindFeatures(scene.Scene, scene.Images, scene.Cluster, options), Error);
}

TEST(EdgeStereo, MissingImage)
{
  const SquaresScene scene;
  std::filesystem::remove(scene.Folder.Path("images/l.png"));
  scene.ExpectOneSentence("images/l.png", "no such file");
}

TEST(EdgeStereo, UnreadableImage)
{
  const SquaresScene scene;
  scene.Folder.Write("images/d.png", "not an image");
  scene.ExpectOneSentence("images/d.png", "damaged");
}

TEST(EdgeStereo, ImageOfAnotherSize)
{
  SquaresScene scene;
  cv::imwrite(scene.Folder.Path("images/r.png"), cv::Mat(90, 120, CV_8UC3, cv::Scalar(1, 2, 3)));
  scene.ExpectOneSentence("images/r.png", "120 x 90");
}

TEST(EdgeStereo, UnknownImage)
{
  SquaresScene scene;
  scene.Cluster.triplets[1][2] = "x.png";
  scene.ExpectOneSentence("x.png", "cross");
}

TEST(EdgeStereo, TripletWithoutOverlap)
{
  SquaresScene scene;
  scene.Images[1].camera = LookAt({ -0.1, 0, 0 }, { -1, 0, -1 });
  scene.ExpectOneSentence("cross", "overlap");
}

TEST(EdgeStereo, FewerThanThreeFeatures)
{
  SquaresScene scene;
  cv::imwrite(scene.Folder.Path("images/c.png"), cv::Mat(180, 240, CV_8UC3, cv::Scalar(1, 2, 3)));
  scene.ExpectOneSentence("cross", "fewer than three features");
}
