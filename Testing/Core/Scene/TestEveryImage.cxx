// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/EveryImage.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

using Triplets = std::vector<std::array<std::string, 3>>;

Cluster CrossCluster(const std::string& name, const std::string& folder)
{
  return { name, folder + "c.jpg",
    { { folder + "l.jpg", folder + "c.jpg", folder + "r.jpg" },
      { folder + "u.jpg", folder + "c.jpg", folder + "d.jpg" } } };
}

}

TEST(EveryImage, OfACross)
{
  const std::vector<Cluster> turned = ClustersOfEveryImage({ CrossCluster("cross", "") });
  ASSERT_EQ(turned.size(), 4u);
  EXPECT_EQ(turned[0].name, "cross_l");
  EXPECT_EQ(turned[0].reference, "l.jpg");
  EXPECT_EQ(
    turned[0].triplets, Triplets({ { "c.jpg", "l.jpg", "r.jpg" }, { "u.jpg", "l.jpg", "d.jpg" } }));
  EXPECT_EQ(
    turned[1].triplets, Triplets({ { "c.jpg", "r.jpg", "l.jpg" }, { "u.jpg", "r.jpg", "d.jpg" } }));
  EXPECT_EQ(turned[2].name, "cross_u");
  EXPECT_EQ(
    turned[2].triplets, Triplets({ { "l.jpg", "u.jpg", "r.jpg" }, { "c.jpg", "u.jpg", "d.jpg" } }));
  EXPECT_EQ(turned[3].name, "cross_d");
}

TEST(EveryImage, OfARow)
{
  const Cluster row{ "row", "2.jpg", { { "1.jpg", "2.jpg", "3.jpg" } } };
  const std::vector<Cluster> turned = ClustersOfEveryImage({ row });
  ASSERT_EQ(turned.size(), 2u);
  EXPECT_EQ(turned[0].triplets, Triplets({ { "2.jpg", "1.jpg", "3.jpg" } }));
  EXPECT_EQ(turned[1].triplets, Triplets({ { "2.jpg", "3.jpg", "1.jpg" } }));
}

TEST(EveryImage, EachImageOnce)
{
  // 1 2 3 4 in a row: 2 and 3 are references of one another's rows.
  const Cluster first{ "first", "2.jpg", { { "1.jpg", "2.jpg", "3.jpg" } } };
  const Cluster second{ "second", "3.jpg", { { "2.jpg", "3.jpg", "4.jpg" } } };
  const std::vector<Cluster> turned = ClustersOfEveryImage({ first, second, first });
  ASSERT_EQ(turned.size(), 2u);
  EXPECT_EQ(turned[0].reference, "1.jpg");
  EXPECT_EQ(turned[1].reference, "4.jpg");
}

TEST(EveryImage, NamesAreUnique)
{
  Cluster taken = CrossCluster("cross_l", "b/");
  taken.triplets.resize(1);
  const std::vector<Cluster> turned = ClustersOfEveryImage({ CrossCluster("cross", "a/"), taken });
  ASSERT_EQ(turned.size(), 6u);
  EXPECT_EQ(turned[0].name, "cross_l_2"); // cross_l is a cluster of the scene
  EXPECT_EQ(turned[4].name, "cross_l_l");
}

TEST(EveryImage, OfNothing)
{
  EXPECT_TRUE(ClustersOfEveryImage({}).empty());
}
