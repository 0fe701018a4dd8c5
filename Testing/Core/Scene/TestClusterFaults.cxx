// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ClusterFaults.h"

#include "Common/Error.h"
#include "Scene/MemoryScene.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

Cluster One(const std::vector<std::array<std::string, 3>>& triplets)
{
  return { "one", "c", triplets };
}

// What a scene of the images c, l and r in memory says of clusters.
std::string FaultInMemory(const std::vector<Cluster>& clusters)
{
  std::vector<MemoryImage> images;
  for (const char* name : { "c", "l", "r" })
  {
    MemoryImage& image = images.emplace_back();
    image.name = name;
    image.pixels = cv::Mat(3, 4, CV_8UC3, cv::Scalar(1, 2, 3));
    image.camera.width = 4;
    image.camera.height = 3;
  }
  try
  {
    MemoryScene(images, clusters);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

}

TEST(ClusterFaults, OfATriplet)
{
  EXPECT_EQ(TripletFault({ "l", "c", "r" }, "c"), "");
  EXPECT_EQ(TripletFault({ "c", "l", "r" }, "c"),
    "the triplet c, l, r does not have the reference c in its middle");
  for (const auto& triplet : { std::array<std::string, 3>{ "l", "c", "l" }, { "c", "c", "r" },
         { "l", "c", "c" }, { "c", "c", "c" } })
  {
    EXPECT_EQ(TripletFault(triplet, "c"),
      "the triplet " + triplet[0] + ", " + triplet[1] + ", " + triplet[2] + " has an image twice");
  }
}

TEST(ClusterFaults, OfAClusterAmongOthers)
{
  std::set<std::string> names = { "two" };
  EXPECT_EQ(ClusterFault(One({}), names), "the cluster one has no triplet");
  EXPECT_EQ(ClusterFault(One({ { "l", "c", "r" } }), names), "");
  EXPECT_EQ(ClusterFault(One({ { "l", "c", "r" } }), names), "two clusters are called one");
}

TEST(ClusterFaults, AreToldOfScenesInMemory)
{
  const Cluster good = One({ { "l", "c", "r" } });
  EXPECT_EQ(FaultInMemory({ good }), "");
  EXPECT_EQ(
    FaultInMemory({ good, good }), "The cluster one is not valid: two clusters are called one.");
  EXPECT_EQ(
    FaultInMemory({ One({}) }), "The cluster one is not valid: the cluster one has no triplet.");
  EXPECT_EQ(FaultInMemory({ One({ { "l", "c", "r" }, { "c", "l", "r" } }) }),
    "The cluster one is not valid: the triplet c, l, r does not have the reference c in its "
    "middle.");
  EXPECT_EQ(FaultInMemory({ One({ { "l", "c", "x" } }) }),
    "The cluster one names an image that is not there, x.");
}
