// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ProposeClusters.h"

#include "Common/Error.h"

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

std::vector<ProposedCluster> Propose(
  const SparseModel& model, const ClusterProposalOptions& options = ClusterProposalOptions())
{
  return ProposeClusters(model, options).clusters;
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
    point.id = 100 + static_cast<std::uint64_t>(i);
    point.position = { coordinate(random), coordinate(random), coordinate(random) };
    for (SparseImage& image : model.images)
    {
      image.observations.push_back({ Eigen::Vector2d(0, 0), point.id });
    }
    model.points.push_back(point);
  }
}

}

TEST(ProposeClusters, OneCross)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  const std::vector<ProposedCluster> clusters = Propose(model);
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
  const std::vector<ProposedCluster> clusters = Propose(rolled);
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(Members(clusters[0]).size(), 5u);
}

TEST(ProposeClusters, SeveralCrosses)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddCross(model, 40, 0, 4);
  AddCross(model, -40, 20, 4);
  EXPECT_EQ(References(Propose(model)), (std::set<int>{ 0, 5, 10 }));
}

// A row's inner images stand between their neighbours, the ends beside them.
TEST(ProposeClusters, Row)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 5; ++i)
  {
    AddImage(model, OnSphere(6 * i, 0), Eigen::Vector3d::Zero());
  }
  const std::vector<ProposedCluster> clusters = Propose(model, All());
  EXPECT_EQ(References(clusters), (std::set<int>{ 0, 1, 2, 3, 4 }));
  ASSERT_EQ(clusters.size(), 5u);
  EXPECT_EQ(clusters[1].triplets[0].neighbors, (std::array<int, 2>{ 0, 2 }));
  EXPECT_EQ(clusters[2].triplets[0].neighbors, (std::array<int, 2>{ 1, 3 }));
  ASSERT_EQ(clusters[2].triplets.size(), 2u) << "one pair farther out";
  EXPECT_EQ(clusters[2].triplets[1].neighbors, (std::array<int, 2>{ 0, 4 }));
  EXPECT_FALSE(clusters[2].cross);
  EXPECT_EQ(Members(clusters[0]), (std::set<int>{ 0, 1, 2 }));
  EXPECT_EQ(Members(clusters[4]), (std::set<int>{ 2, 3, 4 }));
  ClusterProposalOptions two = All();
  two.neighbors = 2;
  EXPECT_EQ(Propose(model, two)[2].triplets.size(), 1u);
}

// What is usual in one part of a set is not held against another: a dense row and a wide one.
TEST(ProposeClusters, EachPartByItsOwnSpacing)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 5; ++i)
  {
    AddImage(model, OnSphere(5 * i - 60, 0), Eigen::Vector3d::Zero());
  }
  for (int i = 0; i < 5; ++i)
  {
    AddImage(model, OnSphere(13 * i, 0), Eigen::Vector3d::Zero());
  }
  const ClusterProposal proposal = ProposeClusters(model, {});
  EXPECT_TRUE(proposal.alone.empty());
  for (int i = 5; i < 10; ++i)
  {
    EXPECT_EQ(References(proposal.clusters).count(i), 1u) << i;
  }
}

// A ring on the way round and some images high above: all are used, in crosses or rows.
TEST(ProposeClusters, RingAndWideTop)
{
  SparseModel model = EmptyModel();
  const auto add = [&](int count, double elevation)
  {
    for (int i = 0; i < count; ++i)
    {
      const double azimuth = 2 * M_PI * i / count, e = elevation * M_PI / 180;
      const Eigen::Vector3d center(
        std::cos(azimuth) * std::cos(e), std::sin(azimuth) * std::cos(e), std::sin(e));
      AddImage(model, center, Eigen::Vector3d::Zero(),
        Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0));
    }
  };
  add(40, 25);
  add(8, 60);
  const ClusterProposal proposal = ProposeClusters(model, {});
  EXPECT_TRUE(proposal.alone.empty());
  const std::set<int> references = References(proposal.clusters);
  EXPECT_EQ(std::count_if(references.begin(), references.end(), [](int i) { return i >= 40; }), 8);
  const auto ring =
    std::count_if(references.begin(), references.end(), [](int i) { return i < 40; });
  EXPECT_LT(ring, 34) << "nine degrees apart: denser than needed";
  EXPECT_GE(ring, 18);
  for (int i = 0; i < 40; ++i)
  {
    EXPECT_TRUE(references.count(i) || references.count((i + 1) % 40)) << "a gap at " << i;
  }
}

// A hemisphere of 300 images: few enough are references, and every image has some near it.
TEST(ProposeClusters, HemisphereIsThinnedEvenly)
{
  SparseModel model = EmptyModel();
  const int count = 300;
  for (int i = 0; i < count; ++i)
  {
    const double z = 0.1 + 0.8 * i / count, azimuth = i * M_PI * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    AddImage(model, { r * std::cos(azimuth), r * std::sin(azimuth), z }, Eigen::Vector3d::Zero(),
      Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0));
  }
  const ClusterProposal proposal = ProposeClusters(model, {});
  EXPECT_TRUE(proposal.alone.empty());
  EXPECT_LT(proposal.clusters.size(), 140u);
  EXPECT_GT(proposal.clusters.size(), 40u);
  EXPECT_EQ(proposal.clusters.size() + proposal.spare.size(), static_cast<std::size_t>(count));
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  for (int i : proposal.spare)
  {
    int near = 0;
    for (int r : References(proposal.clusters))
    {
      const double distance = (images[i].camera.Center() - images[r].camera.Center()).norm();
      near += distance < std::tan(20.5 * M_PI / 180);
    }
    EXPECT_GE(near, 3) << "image " << i;
  }
  for (const ProposedCluster& cluster : proposal.clusters)
  {
    EXPECT_EQ(cluster.triplets.size(), 2u);
  }
}

// Nine cameras in a square, all looking the same way: a cross in the middle, rows around it.
TEST(ProposeClusters, ArrayOfParallelCameras)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 9; ++i)
  {
    const Eigen::Vector3d center(0.1 * (i % 3), 0.1 * (i / 3), 0);
    AddImage(model, center, center + Eigen::Vector3d::UnitZ());
  }
  const ClusterProposal proposal = ProposeClusters(model, All());
  ASSERT_EQ(proposal.clusters.size(), 9u);
  EXPECT_TRUE(proposal.clusters[4].cross);
  EXPECT_EQ(Members(proposal.clusters[4]), (std::set<int>{ 1, 3, 4, 5, 7 }));
}

// Along a street, parallel cameras with overlap: all but what the separation merges.
TEST(ProposeClusters, Street)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 30; ++i)
  {
    AddImage(model, { 0.1 * i, 0, 0 }, { 0.1 * i, 0, 1 });
  }
  AddPoints(model, 0, 0);
  const ClusterProposal proposal = ProposeClusters(model, {});
  EXPECT_TRUE(proposal.alone.empty());
  EXPECT_GE(proposal.clusters.size(), 9u);
}

// In the hand: the way wobbles up and down, and the distance changes.
TEST(ProposeClusters, ArcInTheHand)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> wobble(-2, 2), distance(0.9, 1.1);
  SparseModel model = EmptyModel();
  for (int i = 0; i < 11; ++i)
  {
    AddImage(model, OnSphere(7 * (i - 5) + wobble(random), wobble(random), distance(random)),
      Eigen::Vector3d(0, 0, 0));
  }
  const ClusterProposal proposal = ProposeClusters(model, {});
  EXPECT_TRUE(proposal.alone.empty());
  EXPECT_GE(proposal.clusters.size(), 9u);
}

TEST(ProposeClusters, TellsWhatBecameOfTheImages)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddImage(model, OnSphere(60, 0), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(DescribeChoice(model, ProposeClusters(model, {})),
    "1 of 6 images are references; 4 see what these see; 1 has no partner: 5.jpg");
}

// The neighbours next to the reference are too near; those at the preferred angle are not.
TEST(ProposeClusters, DenseRowTakesThePreferredAngle)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 121; ++i)
  {
    AddImage(model, OnSphere((i - 60) * 0.25, 0), Eigen::Vector3d::Zero());
  }
  const std::vector<ProposedCluster> clusters = Propose(model);
  EXPECT_LE(clusters.size(), 7u) << "30 degrees at a separation of 5";
  const std::set<int> references = References(clusters);
  for (int i = 0; i < 121; ++i)
  {
    // The separation, and a little more: an image that several references cover is not one itself.
    const auto isNear = [i](int reference) { return 0.25 * std::abs(reference - i) <= 6.0; };
    EXPECT_TRUE(std::any_of(references.begin(), references.end(), isNear)) << "image " << i;
  }
  for (const ProposedCluster& cluster : clusters)
  {
    const std::array<int, 2>& neighbors = cluster.triplets[0].neighbors;
    if (neighbors[0] > cluster.reference || neighbors[1] < cluster.reference)
    {
      continue; // at an end
    }
    EXPECT_NEAR(cluster.triplets[0].angle[0], 5, 1.5);
    EXPECT_NEAR(cluster.triplets[0].angle[1], 5, 1.5);
  }
}

TEST(ProposeClusters, ReferencesKeepTheirSeparation)
{
  SparseModel model = EmptyModel();
  for (int i = 0; i < 81; ++i)
  {
    AddImage(model, OnSphere(i % 9 * 3 - 12, i / 9 * 3 - 12), Eigen::Vector3d::Zero());
  }
  ClusterProposalOptions separated;
  separated.coverage = 0;
  const std::vector<ProposedCluster> chosen = Propose(model, separated);
  const std::vector<ProposedCluster> all = Propose(model, All());
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
  EXPECT_EQ(Propose(model).front().triplets.size(), 1u);
  EXPECT_EQ(References(Propose(model, All())), (std::set<int>{ 0, 1, 2 }));
}

// By the axes the scene is at 1; the points, which decide, are at 0.4 where the angles are too
// wide.
TEST(ProposeClusters, PointsTellTheDepth)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 14);
  ASSERT_FALSE(Propose(model).empty());
  AddPoints(model, 50, 0.05);
  EXPECT_FALSE(Propose(model).empty());
  for (SparsePoint& point : model.points)
  {
    point.position.z() -= 0.6;
  }
  EXPECT_TRUE(Propose(model).empty());
}

// Images that have no point in common do not see the same thing, even where geometry says so.
TEST(ProposeClusters, NothingInCommon)
{
  SparseModel model = EmptyModel();
  AddCross(model, 0, 0, 4);
  AddPoints(model, 50, 0.05);
  model.images[1].observations.clear();
  const std::vector<ProposedCluster> clusters = Propose(model);
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(Members(clusters[0]), (std::set<int>{ 0, 3, 4 }));
}

TEST(ProposeClusters, TooFewImages)
{
  SparseModel model = EmptyModel();
  EXPECT_TRUE(Propose(model).empty());
  AddImage(model, OnSphere(0, 0), Eigen::Vector3d::Zero());
  EXPECT_TRUE(Propose(model).empty());
  AddImage(model, OnSphere(4, 0), Eigen::Vector3d::Zero());
  EXPECT_TRUE(Propose(model).empty());
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
  EXPECT_TRUE(Propose(same).empty());
  EXPECT_TRUE(Propose(forward).empty());
}

TEST(ProposeClusters, OptionsOutOfRange)
{
  ClusterProposalOptions options;
  options.minimumAngle = 0;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.preferredAngle = 31;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.minimumOverlap = NAN;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.neighbors = 3;
  EXPECT_THROW(ProposeClusters(EmptyModel(), options), Error);
  options = {};
  options.coverageAngle = 0;
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
  const std::vector<Cluster> clusters = ClustersFromProposal(model, Propose(model));
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0].name, "a_x.jpg");
  EXPECT_EQ(clusters[1].reference, "b/x.jpg");
  EXPECT_EQ(clusters[1].triplets[0][1], "b/x.jpg");
}
