// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ProposeClusters.h"

#include "Common/Error.h"
#include "Scene/CenterIndex.h"
#include "Support/SharedData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace freespace;

namespace
{

// A model of cameras with a field of view of about 44 degrees, all of one lens.
SparseModel EmptyModel()
{
  SparseModel model;
  model.cameras.push_back({ 1, LensModel::Pinhole, 800, 800, { 1000, 1000, 400, 400 } });
  return model;
}

// Adds an image that looks from a place at another, its x axis as far as can be along `right`.
void AddImage(SparseModel& model, const Eigen::Vector3d& center, const Eigen::Vector3d& target,
  const Eigen::Vector3d& right = Eigen::Vector3d::UnitX())
{
  Eigen::Matrix3d R;
  R.row(2) = (target - center).normalized();
  R.row(1) = R.row(2).transpose().cross(right).normalized();
  R.row(0) = R.row(1).transpose().cross(R.row(2).transpose());
  const Eigen::Quaterniond q(R);
  SparseImage image;
  image.id = static_cast<std::uint32_t>(model.images.size() + 1);
  image.name = std::to_string(model.images.size()) + ".jpg";
  image.camera = 1;
  image.rotation = { q.w(), q.x(), q.y(), q.z() };
  image.translation = -(R * center);
  model.images.push_back(image);
}

// Where a camera stands that sees the origin from a distance, seen at two angles in degrees.
Eigen::Vector3d OnSphere(double right, double down, double distance = 1)
{
  return distance *
    Eigen::Vector3d(std::tan(right * M_PI / 180), std::tan(down * M_PI / 180), -1).normalized();
}

void AddCross(SparseModel& model, double right, double down, double arm)
{
  const Eigen::Vector3d origin(0, 0, 0);
  AddImage(model, OnSphere(right, down), origin);
  AddImage(model, OnSphere(right - arm, down), origin);
  AddImage(model, OnSphere(right + arm, down), origin);
  AddImage(model, OnSphere(right, down - arm), origin);
  AddImage(model, OnSphere(right, down + arm), origin);
}

std::set<int> References(const std::vector<ProposedCluster>& clusters)
{
  std::set<int> references;
  for (const ProposedCluster& cluster : clusters)
  {
    references.insert(cluster.reference);
  }
  return references;
}

std::set<int> Members(const ProposedCluster& cluster)
{
  std::set<int> members = { cluster.reference };
  for (const ProposedTriplet& triplet : cluster.triplets)
  {
    members.insert(triplet.neighbors.begin(), triplet.neighbors.end());
  }
  return members;
}

ClusterProposalOptions All()
{
  ClusterProposalOptions options;
  options.separation = 0;
  return options;
}

// Points in a cube about the origin, observed by every image.
void AddPoints(SparseModel& model, int count, double size)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-size, size);
  for (int i = 0; i < count; ++i)
  {
    SparsePoint point;
    point.id = static_cast<std::uint64_t>(100 + i);
    point.position = { coordinate(random), coordinate(random), coordinate(random) };
    for (SparseImage& image : model.images)
    {
      image.observations.push_back({ Eigen::Vector2d(0, 0), point.id });
    }
    model.points.push_back(point);
  }
}

}

TEST(CenterIndex, AgainstBruteForce)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Eigen::Vector3d> centers;
  for (int i = 0; i < 300; ++i)
  {
    centers.push_back({ coordinate(random), coordinate(random), coordinate(random) });
  }
  const CenterIndex index(centers);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Vector3d query(coordinate(random), coordinate(random), coordinate(random));
    std::vector<int> order(centers.size()), within;
    for (int i = 0; i < 300; ++i)
    {
      order[i] = i;
      if ((centers[i] - query).norm() < 0.4)
      {
        within.push_back(i);
      }
    }
    std::sort(order.begin(), order.end(),
      [&](int a, int b)
      { return (centers[a] - query).squaredNorm() < (centers[b] - query).squaredNorm(); });
    order.resize(7);
    EXPECT_EQ(index.Nearest(query, 7), order);
    EXPECT_EQ(index.Within(query, 0.4), within);
  }
}

TEST(CenterIndex, EmptyAndDuplicates)
{
  const CenterIndex empty({});
  EXPECT_TRUE(empty.Nearest({ 0, 0, 0 }, 3).empty());
  EXPECT_TRUE(empty.Within({ 0, 0, 0 }, 3).empty());
  const CenterIndex same(std::vector<Eigen::Vector3d>(100, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(same.Nearest({ 0, 0, 0 }, 5).size(), 5u);
  EXPECT_EQ(same.Within({ 1, 2, 3 }, 0.1).size(), 100u);
}

TEST(ProposeClusters, OneCross)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  const std::vector<ProposedCluster> clusters = ProposeClusters(model, {});
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(clusters[0].reference, 0);
  ASSERT_EQ(clusters[0].triplets.size(), 2u);
  EXPECT_EQ(Members(clusters[0]), (std::set<int>{ 0, 1, 2, 3, 4 }));
  for (const ProposedTriplet& triplet : clusters[0].triplets)
  {
    EXPECT_EQ(triplet.neighbors[0] + 1, triplet.neighbors[1])
      << "left before right, up before down";
    EXPECT_NEAR(triplet.angle[0], 4, 0.01);
    EXPECT_NEAR(triplet.angle[1], 4, 0.01);
    EXPECT_GT(triplet.overlap[0], 0.8);
  }
}

// A rolled camera makes the same cluster: rectification takes the roll out.
TEST(ProposeClusters, RolledReference)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  SparseModel rolled = EmptyModel();
  AddImage(rolled, OnSphere(0, 0), Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0.5, 0));
  rolled.images.insert(rolled.images.end(), model.images.begin() + 1, model.images.end());
  const std::vector<ProposedCluster> clusters = ProposeClusters(rolled, {});
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(Members(clusters[0]).size(), 5u);
}

TEST(ProposeClusters, SeveralCrosses)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddCross(model, 40, 0, 4);
  AddCross(model, -40, 20, 4);
  EXPECT_EQ(References(ProposeClusters(model, {})), (std::set<int>{ 0, 5, 10 }));
}

TEST(ProposeClusters, Row)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 5; ++i)
  {
    AddImage(model, OnSphere(6 * i, 0), Eigen::Vector3d::Zero());
  }
  const std::vector<ProposedCluster> clusters = ProposeClusters(model, All());
  EXPECT_EQ(References(clusters), (std::set<int>{ 1, 2, 3 }));
  ASSERT_FALSE(clusters.empty());
  ASSERT_EQ(clusters[0].triplets.size(), 1u);
  EXPECT_EQ(clusters[0].triplets[0].neighbors, (std::array<int, 2>{ 0, 2 }));
}

// The neighbours next to the reference are too near; those at the preferred angle are not.
TEST(ProposeClusters, DenseRowTakesThePreferredAngle)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 121; ++i)
  {
    AddImage(model, OnSphere((i - 60) * 0.25, 0), Eigen::Vector3d::Zero());
  }
  const std::vector<ProposedCluster> clusters = ProposeClusters(model, {});
  EXPECT_LE(clusters.size(), 6u) << "30 degrees at a separation of 5";
  EXPECT_GE(clusters.size(), 3u);
  for (const ProposedCluster& cluster : clusters)
  {
    EXPECT_NEAR(cluster.triplets[0].angle[0], 5, 0.6);
    EXPECT_NEAR(cluster.triplets[0].angle[1], 5, 0.6);
  }
}

TEST(ProposeClusters, ReferencesKeepTheirSeparation)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 81; ++i)
  {
    AddImage(model, OnSphere(i % 9 * 3 - 12, i / 9 * 3 - 12), Eigen::Vector3d::Zero());
  }
  const std::vector<ProposedCluster> chosen = ProposeClusters(model, {});
  const std::vector<ProposedCluster> all = ProposeClusters(model, All());
  EXPECT_GE(all.size(), 49u) << "every image inside the grid can be a reference";
  EXPECT_LT(chosen.size(), all.size() / 2);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const auto distance = [&](int a, int b)
  { return (images[a].camera.Center() - images[b].camera.Center()).norm(); };
  const double separation = std::tan(5 * M_PI / 180);
  for (int a : References(all))
  {
    double nearest = 1e9;
    for (int b : References(chosen))
    {
      EXPECT_TRUE(a == b || !References(chosen).count(a) || distance(a, b) >= separation * 0.999);
      nearest = std::min(nearest, distance(a, b));
    }
    EXPECT_LT(nearest, separation * 1.001) << "image " << a << " has no reference near it";
  }
}

TEST(ProposeClusters, ParallelCameras)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 3; ++i)
  {
    AddImage(model, { 0.1 * i, 0, 0 }, { 0.1 * i, 0, 1 });
  }
  EXPECT_EQ(References(ProposeClusters(model, {})), (std::set<int>{ 1 }));
}

// By the axes the scene is at 1; the points, which decide, are at 0.4 where the angles are too
// wide.
TEST(ProposeClusters, PointsTellTheDepth)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 12);
  ASSERT_EQ(ProposeClusters(model, {}).size(), 1u);
  AddPoints(model, 50, 0.05);
  EXPECT_EQ(ProposeClusters(model, {}).size(), 1u);
  for (SparsePoint& point : model.points)
  {
    point.position.z() -= 0.6;
  }
  EXPECT_TRUE(ProposeClusters(model, {}).empty());
}

// Images that have no point in common do not see the same thing, even where geometry says so.
TEST(ProposeClusters, NothingInCommon)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddPoints(model, 50, 0.05);
  model.images[1].observations.clear();
  const std::vector<ProposedCluster> clusters = ProposeClusters(model, {});
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(Members(clusters[0]), (std::set<int>{ 0, 3, 4 }));
}

TEST(ProposeClusters, TooFewImages)
{
  SparseModel model = EmptyModel();
  EXPECT_TRUE(ProposeClusters(model, {}).empty());
  AddImage(model, OnSphere(0, 0), Eigen::Vector3d::Zero());
  EXPECT_TRUE(ProposeClusters(model, {}).empty());
  AddImage(model, OnSphere(4, 0), Eigen::Vector3d::Zero());
  EXPECT_TRUE(ProposeClusters(model, {}).empty());
}

TEST(ProposeClusters, CoincidentCamerasAndAForwardRow)
{
  SparseModel same = EmptyModel();
  SparseModel forward = EmptyModel();
  for (int i = 0; i < 9; ++i)
  {
    AddImage(same, OnSphere(0, 0), Eigen::Vector3d::Zero());
    AddImage(forward, { 0, 0, 0.1 * i }, { 0, 0, 5 });
  }
  EXPECT_TRUE(ProposeClusters(same, {}).empty());
  EXPECT_TRUE(ProposeClusters(forward, {}).empty());
}

TEST(ProposeClusters, OptionsOutOfRange)
{
  ClusterProposalOptions options;
  options.minimumAngle = 0;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.preferredAngle = 30;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.minimumOverlap = NAN;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.separation = -1;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
}

TEST(ProposeClusters, NamesAfterTheReference)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddCross(model, 40, 0, 4);
  model.images[0].name = "a/x.jpg";
  model.images[5].name = "b/x.jpg";
  const std::vector<Cluster> clusters = ClustersFromProposal(model, ProposeClusters(model, {}));
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0].name, "a_x.jpg");
  EXPECT_EQ(clusters[1].reference, "b/x.jpg");
  EXPECT_EQ(clusters[1].triplets[0][1], "b/x.jpg");
}

// The six crosses of the blocks scene, and all arcs of the vase's, are found without being told.
TEST(ProposeClusters, ClustersOfTheSharedScenes)
{
  for (const std::string name : { "blocks", "charuco", "vase" })
  {
    const std::string file = SharedData(name + "/scene.json");
    if (file.empty())
    {
      GTEST_SKIP() << "no shared data";
    }
    const Scene scene = ReadScene(file);
    const SparseModel model = ReadSceneModel(scene);
    const std::vector<Cluster> found = ClustersFromProposal(model, ProposeClusters(model, {}));
    EXPECT_EQ(found.size(), scene.clusters.size()) << name;
    for (const Cluster& expected : scene.clusters)
    {
      const auto same = std::find_if(found.begin(), found.end(),
        [&](const Cluster& cluster) { return cluster.reference == expected.reference; });
      ASSERT_NE(same, found.end()) << name << ": " << expected.reference;
      const std::set<std::array<std::string, 3>> a(same->triplets.begin(), same->triplets.end());
      const std::set<std::array<std::string, 3>> b(
        expected.triplets.begin(), expected.triplets.end());
      EXPECT_EQ(a, b) << name << ": " << expected.reference;
    }
  }
}
