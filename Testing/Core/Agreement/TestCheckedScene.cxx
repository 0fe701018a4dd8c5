// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/CheckedScene.h"

#include "Support/Scenes/RowScene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace freespace;

namespace
{

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

TEST(CheckedScene, RightOnesAllStay)
{
  const CheckedScene checked = RowScene().Check();
  EXPECT_TRUE(checked.warnings.empty());
  EXPECT_EQ(checked.model.images.size(), std::size_t(RowScene::Count));
  EXPECT_FALSE(checked.choice.empty());
}

TEST(CheckedScene, TurnedImagesAreLeftOut)
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

TEST(CheckedScene, AMovedCameraIsLeftOut)
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

TEST(CheckedScene, NamedClustersAreMadeOfTheRest)
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
