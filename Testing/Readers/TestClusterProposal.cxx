// SPDX-License-Identifier: BSD-3-Clause
#include "vtkClusterProposal.h"

#include "Scene/Scene.h"
#include "Support/ErrorObserver.h"
#include "Support/SharedData.h"
#include "Support/TemporaryFolder.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

using namespace freespace;

TEST(ClusterProposal, SavedAndReadAgain)
{
  const std::string file = SharedData("blocks/scene.json");
  if (file.empty())
  {
    GTEST_SKIP() << "no shared data";
  }
  vtkNew<vtkClusterProposal> proposal;
  proposal->SetFileName(file);
  ASSERT_EQ(proposal->Propose(), 1);
  EXPECT_EQ(proposal->GetNumberOfClusters(), 6);
  EXPECT_EQ(proposal->GetReference(0), "cluster1_c.jpg");
  EXPECT_EQ(proposal->GetNumberOfTriplets(0), 2);
  EXPECT_NE(proposal->GetText().find("cluster1_c.jpg: cross"), std::string::npos);
  TemporaryFolder folder;
  ASSERT_EQ(proposal->WriteScene(folder.Path("scene.json")), 1);
  const Scene scene = ReadScene(folder.Path("scene.json"));
  EXPECT_EQ(scene.clusters.size(), 6u);
  EXPECT_EQ(ReadSceneImages(scene).size(), 30u) << "the relative folders still hold";
}

TEST(ClusterProposal, OfAModelWithoutAScene)
{
  const std::string data = SharedData("charuco");
  if (data.empty())
  {
    GTEST_SKIP() << "no shared data";
  }
  ExpectedErrors errors;
  vtkNew<vtkClusterProposal> proposal;
  proposal->SetModel(data + "/sparse");
  ASSERT_EQ(proposal->Propose(), 1);
  EXPECT_EQ(proposal->GetNumberOfClusters(), 3);
  TemporaryFolder folder;
  EXPECT_EQ(proposal->WriteScene(folder.Path("scene.json")), 0);
  EXPECT_TRUE(errors.Has("the folder of the images was not given"));
  proposal->SetImages(data + "/images");
  ASSERT_EQ(proposal->Propose(), 1);
  ASSERT_EQ(proposal->WriteScene(folder.Path("scene.json")), 1);
  const Scene scene = ReadScene(folder.Path("scene.json"));
  EXPECT_EQ(scene.clusters.size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(scene.ImagePath("cluster1_c.jpg")));
}

TEST(ClusterProposal, BadInput)
{
  ExpectedErrors errors;
  vtkNew<vtkClusterProposal> proposal;
  proposal->SetFileName("/no/such/scene.json");
  EXPECT_EQ(proposal->Propose(), 0);
  EXPECT_TRUE(errors.Has("/no/such/scene.json"));
  EXPECT_EQ(proposal->GetNumberOfClusters(), 0);
  EXPECT_EQ(proposal->GetReference(0), "");
  EXPECT_EQ(proposal->GetNumberOfTriplets(-1), 0);
  TemporaryFolder folder;
  EXPECT_EQ(proposal->WriteScene(folder.Path("scene.json")), 0);
  EXPECT_TRUE(errors.Has("no clusters were chosen"));
  folder.Write("sparse/cameras.txt", "1 PINHOLE 640 480 500 510 320 240\n");
  folder.Write("sparse/images.txt", "1 1 0 0 0 0 0 0 1 a.jpg\n\n");
  proposal->SetFileName(
    folder.Write("scene.json", R"({ "images": "pictures", "model": "sparse" })"));
  EXPECT_EQ(proposal->Propose(), 0) << "one image has no neighbours";
  EXPECT_TRUE(errors.Has("has two neighbours at angles"));
}
