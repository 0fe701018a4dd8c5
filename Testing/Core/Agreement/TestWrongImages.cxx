// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/CheckedScene.h"

#include "Agreement/SceneFeatures.h"
#include "Common/Error.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

// Two slanted planes of coloured squares, photographed from a row of seven places, on disk.
class RowScene
{
public:
  static constexpr int Count = 7;

  RowScene()
  {
    Layer back, front;
    back.depth = 1.2;
    back.exists = Everywhere();
    back.color = RandomSquares(0.05, 5);
    front.depth = 0.9;
    front.slope = { 0.3, 0.1 };
    front.exists = [](double x, double y) { return x * x + y * y < 0.02; };
    front.color = RandomSquares(0.04, 9);
    std::filesystem::create_directories(this->Folder.Path("images"));
    std::ostringstream images;
    images.precision(17);
    for (int i = 0; i < Count; ++i)
    {
      const double x = 0.1 * (i - Count / 2);
      this->Cameras.push_back(LookAt({ x, 0.02 * (i % 2), 0.1 * x * x }, { 0, 0, 1 }));
      cv::imwrite(this->File(i), Render({ back, front }, this->Cameras[i], nullptr, 12));
    }
    this->WriteModel();
    this->Path = this->Folder.Write("scene.json", R"({ "images": "images", "model": "sparse" })");
  }

  std::string File(int i) const
  {
    return this->Folder.Path("images/" + std::to_string(i) + ".png");
  }

  void Turn(int i) const
  {
    cv::Mat turned;
    cv::rotate(cv::imread(this->File(i)), turned, cv::ROTATE_180);
    cv::imwrite(this->File(i), turned);
  }

  void WriteModel() const
  {
    std::ostringstream images;
    images.precision(17);
    for (int i = 0; i < Count; ++i)
    {
      const Eigen::Quaterniond q(this->Cameras[i].R);
      const Eigen::Vector3d& t = this->Cameras[i].t;
      images << i + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' '
             << t.x() << ' ' << t.y() << ' ' << t.z() << " 1 " << i << ".png\n\n";
    }
    this->Folder.Write("sparse/images.txt", images.str());
    this->Folder.Write("sparse/cameras.txt", "1 PINHOLE 240 180 400 400 121.3 88.6\n");
  }

  CheckedScene Check(bool check = true) const
  {
    const Scene scene = ReadScene(this->Path);
    EdgeStore edges(scene, EdgeTokenOptions());
    return CheckScene(scene, ReadSceneModel(scene), edges, MatcherOptions(),
      ClusterProposalOptions(), check, SerialFor, Progress());
  }

  TemporaryFolder Folder;
  std::vector<Camera> Cameras;
  std::string Path;
};

std::vector<std::string> NamesOf(const SparseModel& model)
{
  std::vector<std::string> names;
  for (const SparseImage& image : model.images)
  {
    names.push_back(image.name);
  }
  return names;
}

}

TEST(WrongImages, RightOnesAllStay)
{
  const CheckedScene checked = RowScene().Check();
  EXPECT_TRUE(checked.warnings.empty());
  EXPECT_EQ(checked.model.images.size(), std::size_t(RowScene::Count));
  EXPECT_FALSE(checked.choice.empty());
}

TEST(WrongImages, TurnedImagesAreLeftOut)
{
  const RowScene scene;
  scene.Turn(1);
  scene.Turn(4);
  const CheckedScene checked = scene.Check();
  EXPECT_EQ(NamesOf(checked.model),
    (std::vector<std::string>{ "0.png", "2.png", "3.png", "5.png", "6.png" }));
  ASSERT_EQ(checked.warnings.size(), 1u);
  EXPECT_NE(checked.warnings[0].find("2 of 7 images are left out"), std::string::npos);
  EXPECT_NE(checked.warnings[0].find("1.png, 4.png"), std::string::npos);
  for (const Cluster& cluster : checked.scene.clusters)
  {
    for (const auto& triplet : cluster.triplets)
    {
      EXPECT_EQ(std::count(triplet.begin(), triplet.end(), "1.png"), 0);
      EXPECT_EQ(std::count(triplet.begin(), triplet.end(), "4.png"), 0);
    }
  }
  EXPECT_EQ(scene.Check(false).model.images.size(), std::size_t(RowScene::Count));
}

TEST(WrongImages, AMovedCameraIsLeftOut)
{
  for (const Eigen::Vector3d& step : { Eigen::Vector3d(0.06, 0, 0), Eigen::Vector3d(0, 0.06, 0) })
  {
    RowScene scene;
    scene.Cameras[3].t += step;
    scene.WriteModel();
    const CheckedScene checked = scene.Check();
    EXPECT_EQ(NamesOf(checked.model),
      (std::vector<std::string>{ "0.png", "1.png", "2.png", "4.png", "5.png", "6.png" }));
  }
}

TEST(WrongImages, NamedClustersAreMadeOfTheRest)
{
  const RowScene scene;
  scene.Turn(3);
  scene.Folder.Write("scene.json", R"({ "images": "images", "model": "sparse", "clusters": [
    { "name": "a", "reference": "3.png", "triplets": [["2.png", "3.png", "4.png"],
                                                      ["1.png", "3.png", "5.png"]] } ] })");
  const CheckedScene checked = scene.Check();
  ASSERT_EQ(checked.scene.clusters.size(), 1u);
  EXPECT_EQ(checked.scene.clusters[0].reference, "2.png");
  EXPECT_TRUE(checked.choice.empty());
}

TEST(SceneFeatures, PoorClustersAreNamedAndLeftOut)
{
  const RowScene scene;
  CheckedScene checked = scene.Check();
  Cluster blank = checked.scene.clusters[0];
  cv::imwrite(scene.File(6), cv::Mat(180, 240, CV_8UC3, cv::Scalar::all(90)));
  blank.name = "blank";
  blank.reference = "6.png";
  blank.triplets = { { "4.png", "6.png", "5.png" } };
  checked.scene.clusters = { blank, { "good", "2.png", { { "1.png", "2.png", "3.png" } } } };
  const auto images = CalibratedImages(checked.model);
  EdgeStore edges(checked.scene, EdgeTokenOptions());
  std::vector<std::string> warnings;
  const auto views = FindSceneFeatures(
    checked.scene, images, edges, 2, EdgeStereoOptions(), SerialFor, Progress(), warnings);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].name, "good");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("blank (fewer than three features)"), std::string::npos);
  checked.scene.clusters.resize(1);
  EXPECT_THROW(FindSceneFeatures(checked.scene, images, edges, 1, EdgeStereoOptions(), SerialFor,
                 Progress(), warnings),
    TooFewFeatures);
}

TEST(SceneFeatures, PoorIsWhatHasMuchLessThanUsual)
{
  std::vector<EdgeView> views(5);
  for (EdgeView& view : views)
  {
    view.points.resize(300);
    view.chainIds.resize(300);
    view.tokens = 1000;
  }
  views[2].chainIds.resize(19); // no patch counts; of 20 that are a fifteenth
  EXPECT_EQ(FindPoorViews(views), (std::vector<char>{ 0, 0, 1, 0, 0 }));
  views[2].chainIds.resize(21);
  EXPECT_EQ(FindPoorViews(views), (std::vector<char>{ 0, 0, 0, 0, 0 }));
  views[2].chainIds.resize(4);
  views.resize(3); // too few to tell what is usual
  EXPECT_EQ(FindPoorViews(views), (std::vector<char>{ 0, 0, 0 }));
  EXPECT_TRUE(FindPoorViews({}).empty());
}
