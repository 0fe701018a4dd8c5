// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/SceneFeatures.h"

#include "Common/Error.h"
#include "Support/Scenes/RowScene.h"

#include <gtest/gtest.h>

using namespace freespace;

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
