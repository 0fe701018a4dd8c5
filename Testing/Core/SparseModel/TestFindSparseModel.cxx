// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/FindSparseModel.h"

#include "Common/Error.h"
#include "Scene/Scene.h"
#include "SparseModel/ColmapModel.h"
#include "ModelFiles/ReadSparseModel.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

void WriteModelAt(const TemporaryFolder& folder, const std::string& place, int images)
{
  std::filesystem::create_directories(folder.Path(place));
  WriteColmapModel(MakeSyntheticModel(images, 20), folder.Path(place), ColmapFormat::Binary);
}

}

TEST(FindSparseModel, AModelIsItself)
{
  const TemporaryFolder folder;
  WriteModelAt(folder, "m", 2);
  WriteModelAt(folder, "m/0", 9);
  std::string told = "?";
  EXPECT_EQ(FindSparseModel(folder.Path("m"), &told), folder.Path("m"));
  EXPECT_EQ(told, "");
  EXPECT_EQ(FindSparseModel(folder.Path("missing"), &told), folder.Path("missing"));
}

TEST(FindSparseModel, TheLargestBelowIsTaken)
{
  const TemporaryFolder folder;
  WriteModelAt(folder, "colmap/sparse/0", 2);
  WriteModelAt(folder, "colmap/sparse/1", 7);
  WriteModelAt(folder, "colmap/sparse/2", 3);
  std::string told;
  EXPECT_EQ(FindSparseModel(folder.Path("colmap"), &told), folder.Path("colmap/sparse/1"));
  EXPECT_NE(told.find("the largest of 3"), std::string::npos);
  EXPECT_TRUE(IsSparseModel(folder.Path("colmap")));
  EXPECT_EQ(ReadSparseModel(folder.Path("colmap/sparse")).images.size(), 7u);
}

TEST(FindSparseModel, NothingIsFoundFarBelowOrBesideAScene)
{
  const TemporaryFolder folder;
  WriteModelAt(folder, "deep/a/b/c/d", 2);
  EXPECT_EQ(FindSparseModel(folder.Path("deep")), folder.Path("deep"));
  EXPECT_FALSE(IsSparseModel(folder.Path("deep")));
  WriteModelAt(folder, "set/sparse", 2);
  folder.Write("set/scene.json", R"({ "images": "images", "model": "sparse" })");
  EXPECT_FALSE(IsSparseModel(folder.Path("set")));
}

TEST(FindSparseModel, AFolderIsAScene)
{
  const TemporaryFolder folder;
  WriteModelAt(folder, "set/sparse/0", 2);
  std::filesystem::create_directories(folder.Path("set/images"));
  const Scene scene = ReadScene(folder.Path("set/sparse/0"));
  EXPECT_EQ(scene.ModelFolder(), folder.Path("set/sparse/0"));
  EXPECT_EQ(scene.ImagesFolder(), folder.Path("set/images"));
  EXPECT_TRUE(scene.clusters.empty());
  EXPECT_EQ(ReadScene(folder.Path("set")).ImagesFolder(), folder.Path("set/images"));
  folder.Write("set/scene.json", R"({ "images": "photos", "model": "sparse/0" })");
  EXPECT_EQ(ReadScene(folder.Path("set")).images, "photos");
  EXPECT_THROW(ReadScene(folder.Path("set/images")), Error);
}
