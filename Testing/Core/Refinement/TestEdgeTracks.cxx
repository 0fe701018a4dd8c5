// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/EdgeTracks.h"

#include "Support/SyntheticImages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace freespace;

namespace
{

constexpr int Reference = 7, Left = 3, Right = 5; // indices of the cameras

EdgeToken TokenAt(const Eigen::Vector2d& position)
{
  EdgeToken token{};
  token.position = position;
  token.tangent = { 0.6, 0.8 };
  token.contrast = 3;
  return token;
}

// A point at depth 2 for each token of the reference; every third is seen by no image, one and two of the others.
ClusterMatches Matches(int tokens)
{
  ClusterMatches cluster;
  cluster.referenceImage = Reference;
  cluster.otherImages = { Left, Right };
  cluster.reference.camera = ParallelCamera(0, 640, 480, 500);
  cluster.others = { { ParallelCamera(-0.1, 640, 480, 500), {} },
    { ParallelCamera(0.2, 640, 480, 500), {} } };
  for (int i = 0; i < tokens; ++i)
  {
    const Eigen::Vector2d pixel(100.0 + i, 50.0 + 2 * i);
    cluster.reference.edges.tokens.push_back(TokenAt(pixel));
    cluster.others[0].edges.tokens.push_back(TokenAt(pixel + Eigen::Vector2d(25, 0)));
    cluster.others[1].edges.tokens.push_back(TokenAt(pixel - Eigen::Vector2d(50, 0)));
    EdgeMatch match;
    match.images = i % 3;
    match.support = static_cast<int>(cluster.support.size());
    match.disparity = 0.5;
    match.imagePoint = pixel;
    for (int image = 2 - match.images; image < 2; ++image)
    {
      EdgeCandidate candidate{};
      candidate.image = image;
      candidate.token = i;
      cluster.support.push_back(candidate);
    }
    cluster.matches.push_back(match);
  }
  return cluster;
}

}

TEST(EdgeTracks, WithoutMatchesThereAreNone)
{
  EXPECT_TRUE(TracksOfCluster(Matches(0), 10).empty());
  EXPECT_TRUE(TracksOfCluster(Matches(2), 10).empty()) << "no third image confirms them";
}

TEST(EdgeTracks, ATrackIsThePointAndItsImages)
{
  const ClusterMatches cluster = Matches(3);
  const std::vector<EdgeTrack> tracks = TracksOfCluster(cluster, 10);
  ASSERT_EQ(tracks.size(), 1u);
  const Eigen::Vector2d pixel(102, 54);
  EXPECT_LT((tracks[0].point - cluster.reference.camera.Unproject(pixel, 2)).norm(), 1e-12);
  ASSERT_EQ(tracks[0].observations.size(), 3u);
  const int images[] = { Reference, Left, Right };
  for (int k = 0; k < 3; ++k)
  {
    const EdgeObservation& seen = tracks[0].observations[k];
    const Camera& camera = k == 0 ? cluster.reference.camera : cluster.others[k - 1].camera;
    EXPECT_EQ(seen.image, images[k]);
    EXPECT_LT((seen.position - camera.Project(tracks[0].point)).norm(), 1e-9);
    EXPECT_LT((seen.normal - Eigen::Vector2d(-0.8, 0.6)).norm(), 1e-12);
    EXPECT_NEAR(seen.uncertainty, std::sqrt(2.0), 1e-6);
  }
}

TEST(EdgeTracks, AsManyAsWantedEvenlyChosen)
{
  const ClusterMatches cluster = Matches(300); // 100 are confirmed
  for (const auto& [most, expected] : { std::pair(1000, 100), std::pair(100, 100),
         std::pair(50, 50), std::pair(10, 10), std::pair(1, 1), std::pair(0, 1) })
  {
    const std::vector<EdgeTrack> tracks = TracksOfCluster(cluster, static_cast<std::size_t>(most));
    ASSERT_EQ(tracks.size(), static_cast<std::size_t>(expected)) << most;
    for (std::size_t i = 1; i < tracks.size(); ++i)
    {
      const Eigen::Vector2d step =
        tracks[i].observations[0].position - tracks[i - 1].observations[0].position;
      EXPECT_NEAR(step.x(), 3.0 * 100 / expected, 1e-9) << most;
    }
  }
}
