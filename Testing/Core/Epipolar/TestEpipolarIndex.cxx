// SPDX-License-Identifier: BSD-3-Clause
// The index of chains against a search over all pieces.
#include "Epipolar/EpipolarIndex.h"

#include "Support/Core/RandomCameras.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace freespace;

namespace
{

Camera CameraAlongX(double x)
{
  return ParallelCamera(x, 320, 240, 400);
}

// Chains that wander over the image in steps of about a pixel.
EdgeChains RandomChains(std::mt19937& random, int chains, int tokens)
{
  std::uniform_real_distribution<double> unit(0, 1);
  EdgeChains edges;
  edges.begin = { 0 };
  for (int chain = 0; chain < chains; ++chain)
  {
    Eigen::Vector2d position(20 + 280 * unit(random), 20 + 200 * unit(random));
    double angle = 2 * M_PI * unit(random);
    for (int i = 0; i < tokens; ++i)
    {
      angle += 0.3 * (unit(random) - 0.5);
      EdgeToken& token = edges.tokens.emplace_back();
      token.position = position;
      token.tangent = { std::cos(angle), std::sin(angle) };
      token.contrast = 10;
      position += token.tangent;
    }
    edges.begin.push_back(static_cast<int>(edges.tokens.size()));
  }
  return edges;
}

}

TEST(EpipolarIndex, FindsWhatASearchOverAllPiecesFinds)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  const EpipolarPair pair(CameraAlongX(0), CameraAlongX(0.3));
  std::size_t found = 0;
  for (int trial = 0; trial < 30; ++trial)
  {
    const EdgeChains edges = RandomChains(random, 1 + trial, 12);
    const EpipolarIndex index(pair, edges, 0.1);
    for (int query = 0; query < 2000; ++query)
    {
      const float row = 240 * unit(random) - 120; // from the axis on
      EpipolarIndex::Search search;
      search.near = 400 * unit(random) - 200;
      search.far = search.near + 150 * unit(random);
      const float angle = 6.2831853F * unit(random);
      search.tangentU = std::cos(angle);
      search.tangentV = std::sin(angle);
      search.minimumCosine = 0.5F;
      std::map<int, float> expected, seen;
      for (int token = 0; token < static_cast<int>(edges.tokens.size()); ++token)
      {
        const EpipolarIndex::Piece& piece = index.PieceOf(token);
        const float u = piece.ColumnAt(row);
        const float cosine =
          std::abs(search.tangentU * piece.tangentU + search.tangentV * piece.tangentV);
        if (!piece.Empty() && piece.Crosses(row) && u >= search.near && u < search.far &&
          cosine >= search.minimumCosine)
        {
          expected[token] = u;
        }
      }
      index.VisitRow(row, search,
        [&](int token, float u, float cosine, float width)
        {
          EXPECT_EQ(seen.count(token), 0u) << "visited twice";
          seen[token] = u;
          EXPECT_GE(cosine, search.minimumCosine);
          EXPECT_GT(width, 0);
        });
      // A crossing at the very end of the columns may round to either side.
      for (const auto& [token, u] : expected)
      {
        const bool isAtTheEnd = std::min(u - search.near, search.far - u) < 1e-3F;
        ASSERT_TRUE(isAtTheEnd || seen.count(token)) << trial << ": " << token << " at " << u;
      }
      for (const auto& [token, u] : seen)
      {
        const bool isAtTheEnd = std::min(u - search.near, search.far - u) < 1e-3F;
        ASSERT_TRUE(isAtTheEnd || expected.count(token)) << trial << ": " << token << " at " << u;
        EXPECT_NEAR(u, index.PieceOf(token).ColumnAt(row), 1e-3);
      }
      found += seen.size();
    }
  }
  EXPECT_GT(found, 500u) << "queries that find nothing prove nothing";
}

// A vertical chain of ten tokens a pixel apart, of parallel cameras: rectified rows are pixels from the axis.
TEST(EpipolarIndex, FollowsAChain)
{
  EdgeChains edges;
  for (int i = 0; i < 10; ++i)
  {
    EdgeToken& token = edges.tokens.emplace_back();
    token.position = { 160, 120.0 + i };
    token.tangent = { 0, 1 };
    token.contrast = 10;
  }
  edges.begin = { 0, 10 };
  const EpipolarIndex index(EpipolarPair(CameraAlongX(0), CameraAlongX(0.3)), edges, 0.1);
  EXPECT_EQ(index.Follow(0, 4.5F, 9), 4);
  EXPECT_EQ(index.Follow(8, 4.5F, 9), 4) << "backwards";
  EXPECT_EQ(index.Follow(0, 4.5F, 3), -1) << "too far away";
  EXPECT_EQ(index.Follow(0, 20, 99), -1) << "beyond the end";
  EXPECT_TRUE(index.PieceOf(9).Empty()) << "nothing starts at the last token";
  EXPECT_TRUE(index.Connects(2, 7, 5));
  EXPECT_TRUE(index.Connects(7, 2, 5));
  EXPECT_FALSE(index.Connects(2, 7, 4));
}

TEST(EpipolarIndex, PiecesAlongTheRowsAreEmpty)
{
  EdgeChains edges;
  for (int i = 0; i < 10; ++i)
  {
    EdgeToken& token = edges.tokens.emplace_back();
    token.position = { 100.0 + i, 100 + 0.01 * i };
    token.tangent = Eigen::Vector2d(1, 0.01).normalized();
    token.contrast = 10;
  }
  edges.begin = { 0, 10 };
  const EpipolarIndex index(EpipolarPair(CameraAlongX(0), CameraAlongX(0.3)), edges, 0.1);
  for (int token = 0; token < 10; ++token)
  {
    EXPECT_TRUE(index.PieceOf(token).Empty()) << token;
  }
}

TEST(EpipolarIndex, NoEdgesAreFound)
{
  EdgeChains none;
  none.begin = { 0 };
  const EpipolarIndex index(EpipolarPair(CameraAlongX(0), CameraAlongX(0.3)), none, 0.1);
  int visits = 0;
  index.VisitRow(0, { -1000, 1000, 0, 1, 0 }, [&](int, float, float, float) { ++visits; });
  EXPECT_EQ(visits, 0);
}

TEST(EpipolarIndex, FindsTheSameAsLookingAtEveryPiece)
{
  RandomCameras random(7);
  const Camera reference = random.Next(), other = random.Next();
  const EpipolarPair pair(reference, other);
  const EdgeChains edges = RandomChainsOf(random, 100);
  const EpipolarIndex index(pair, edges, 0.1);
  int found = 0;
  for (int trial = 0; trial < 500; ++trial)
  {
    const EpipolarPair::Ray ray =
      pair.FromReference({ random.Uniform(0, 600), random.Uniform(0, 400) });
    const float row = static_cast<float>(ray.v);
    EpipolarIndex::Search search;
    search.near = static_cast<float>(ray.u - random.Uniform(50, 400));
    search.far = static_cast<float>(ray.u + random.Uniform(50, 400));
    search.tangentU = 0.6f;
    search.tangentV = 0.8f;
    search.minimumCosine = 0.7f;
    std::vector<int> expected, visited;
    for (int token = 0; token < static_cast<int>(edges.tokens.size()); ++token)
    {
      const EpipolarIndex::Piece& piece = index.PieceOf(token);
      const float u = piece.ColumnAt(row);
      const float cosine = std::abs(0.6f * piece.tangentU + 0.8f * piece.tangentV);
      if (piece.Crosses(row) && u >= search.near && u < search.far &&
        cosine >= search.minimumCosine)
      {
        expected.push_back(token);
      }
    }
    index.VisitRow(row, search,
      [&](int token, float u, float, float width)
      {
        const EpipolarIndex::Piece& piece = index.PieceOf(token);
        EXPECT_NEAR(u, piece.ColumnAt(row), 1e-3);
        EXPECT_FLOAT_EQ(width, piece.uncertainty / std::abs(piece.tangentV));
        visited.push_back(token);
      });
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected);
    found += static_cast<int>(expected.size());
  }
  EXPECT_GT(found, 500);
}

TEST(EpipolarIndex, FollowsAChainToARowAndNotBeyondItsEnd)
{
  RandomCameras random(8);
  const Camera reference = random.Next(), other = random.Next();
  const EpipolarPair pair(reference, other);
  const EdgeChains edges = RandomChainsOf(random, 50);
  const EpipolarIndex index(pair, edges, 0.1);
  int followed = 0;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    const int begin = edges.begin[chain], end = edges.begin[chain + 1];
    EXPECT_TRUE(index.PieceOf(end - 1).Empty());
    for (int token = begin; token < end; ++token)
    {
      const float row =
        index.PieceOf(token).v + static_cast<float>(random.Uniform(-1, 1)) * (end - begin);
      const int reached = index.Follow(token, row, 2 * (end - begin));
      if (reached >= 0)
      {
        EXPECT_GE(reached, begin);
        EXPECT_LT(reached, end - 1);
        EXPECT_TRUE(index.PieceOf(reached).Crosses(row));
        ++followed;
      }
    }
  }
  EXPECT_GT(followed, 100);
}
