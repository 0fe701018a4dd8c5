// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarPair.h"

#include "Common/Error.h"
#include "Epipolar/DisparityRange.h"
#include "Epipolar/EpipolarIndex.h"
#include "Epipolar/EpipolarRays.h"
#include "Matching/ProximityBins.h"
#include "Support/SyntheticImages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace freespace;

namespace
{

class RandomCameras
{
public:
  explicit RandomCameras(unsigned int seed)
    : Random(seed)
  {
  }

  Camera Next()
  {
    return LookAt({ this->Uniform(-0.3, 0.3), this->Uniform(-0.3, 0.3), this->Uniform(-0.1, 0.1) },
      { this->Uniform(-0.2, 0.2), this->Uniform(-0.2, 0.2), 1 });
  }
  double Uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Random);
  }

private:
  std::mt19937 Random;
};

}

TEST(EpipolarPair, PointsLieOnOneRowAndGiveTheirDisparity)
{
  for (unsigned int seed = 0; seed < 50; ++seed)
  {
    RandomCameras random(seed);
    const Camera reference = random.Next(), other = random.Next();
    const EpipolarPair pair(reference, other);
    const Eigen::Vector3d point(
      random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), random.Uniform(0.7, 1.5));
    const EpipolarPair::Ray a = pair.FromReference(reference.Project(point));
    const EpipolarPair::Ray b = pair.FromOther(other.Project(point));
    EXPECT_GT(a.scale, 0);
    EXPECT_NEAR(a.v, b.v, 1e-8) << seed;
    const double disparity = 1 / reference.Depth(point);
    EXPECT_NEAR(pair.Disparity(a, b.u), disparity, 1e-9) << seed;
    EXPECT_NEAR(pair.Column(a, disparity), b.u, 1e-6) << seed;
  }
}

TEST(EpipolarPair, JacobianIsTheDerivative)
{
  RandomCameras random(7);
  const Camera reference = random.Next(), other = random.Next();
  const EpipolarPair pair(reference, other);
  const Eigen::Vector2d pixel(70, 120);
  const EpipolarPair::Ray ray = pair.FromReference(pixel);
  const Eigen::Matrix2d jacobian = pair.ReferenceJacobian(ray);
  for (int k = 0; k < 2; ++k)
  {
    const double step = 1e-4;
    const EpipolarPair::Ray moved = pair.FromReference(pixel + step * Eigen::Vector2d::Unit(k));
    EXPECT_NEAR((moved.u - ray.u) / step, jacobian(0, k), 1e-4);
    EXPECT_NEAR((moved.v - ray.v) / step, jacobian(1, k), 1e-4);
  }
}

TEST(EpipolarPair, OnePlace)
{
  const Camera camera = CrossOfCameras()[0];
  EXPECT_THROW(EpipolarPair(camera, camera), Error);
}

TEST(EpipolarPair, OneStraightBeforeTheOther)
{
  Camera other = CrossOfCameras()[0];
  other.t = Eigen::Vector3d(0, 0, -0.2);
  const EpipolarPair pair(CrossOfCameras()[0], other); // useless, but no error
  EXPECT_TRUE(std::isfinite(pair.FromReference({ 10, 10 }).scale));
}

TEST(CommonVolume, VisibleRangeAgreesWithSampling)
{
  int seen = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    RandomCameras random(seed);
    const Camera reference = random.Next(), other = random.Next();
    const Eigen::Vector2d pixel(random.Uniform(0, 240), random.Uniform(0, 180));
    const DisparityRange range = VisibleRange(reference, pixel, other, { 0.05, 20 });
    for (double disparity = 0.06; disparity < 20; disparity *= 1.07)
    {
      const Eigen::Vector3d point = reference.Unproject(pixel, 1 / disparity);
      const bool visible = other.Depth(point) > 0 && other.Sees(other.Project(point));
      EXPECT_EQ(visible, disparity >= range.minimum && disparity <= range.maximum)
        << seed << " " << disparity;
      seen += visible;
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(CommonVolume, CamerasThatLookApartHaveNone)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const Camera ahead = LookAt({ 0, 0, 0 }, { 0, 0, 1 });
  EXPECT_FALSE(CommonRange(
    ahead, LookAt({ -0.1, 0, 0 }, { 0, 0, 1 }), LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 0, infinity })
                 .Empty());
  EXPECT_TRUE(CommonRange(ahead, LookAt({ -0.1, 0, 0 }, { -1, 0, -1 }),
    LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 0, infinity })
                .Empty());
  EXPECT_TRUE(CommonRange(
    ahead, LookAt({ -0.1, 0, 0 }, { 0, 0, 1 }), LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 1e4, 1e5 })
                .Empty()); // too near
}

namespace
{

// Chains that wander over the image.
EdgeChains RandomChainsOf(RandomCameras& random, int count)
{
  EdgeChains edges;
  for (int chain = 0; chain < count; ++chain)
  {
    Eigen::Vector2d position(random.Uniform(50, 550), random.Uniform(50, 350));
    double angle = random.Uniform(-3, 3);
    for (int k = 0; k < 40; ++k)
    {
      EdgeToken token{};
      token.contrast = 10;
      token.position = position;
      token.tangent = { std::cos(angle), std::sin(angle) };
      edges.tokens.push_back(token);
      position += token.tangent;
      angle += random.Uniform(-0.1, 0.1);
    }
    edges.begin.push_back(static_cast<int>(edges.tokens.size()));
  }
  return edges;
}

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

// Places of several images, some far along a line, held against looking at every pair.
TEST(ProximityBins, MissNoPlaceThatMeetsAnother)
{
  RandomCameras random(11);
  int met = 0, alone = 0, wrong = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    struct Place
    {
      int image;
      float center, reach;
    };
    std::vector<Place> places;
    ProximityBins bins(3);
    bins.Clear();
    for (int k = 0; k < 40; ++k)
    {
      places.push_back({ k % 3, static_cast<float>(random.Uniform(-900, 900)),
        static_cast<float>(k % 7 == 0 ? random.Uniform(0, 150) : random.Uniform(0, 3)) });
      bins.Add(places.back().image, places.back().center, places.back().reach);
    }
    bins.Finish();
    for (const Place& a : places)
    {
      const bool expected = std::any_of(places.begin(), places.end(),
        [&](const Place& b) {
          return b.image != a.image && std::abs(a.center - b.center) <= std::max(a.reach, b.reach);
        });
      const bool found = bins.Meets(a.image, a.center, a.reach);
      EXPECT_TRUE(found || !expected) << trial << " " << a.center << " " << a.reach;
      met += expected;
      alone += !expected;
      wrong += found && !expected;
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(wrong, alone / 2); // or it would save nothing
}

TEST(EpipolarRays, AreThoseOfThePairTokenByToken)
{
  RandomCameras random(13);
  const Camera reference = random.Next(), other = random.Next();
  const EpipolarPair pair(reference, other);
  const EdgeChains edges = RandomChainsOf(random, 20);
  EpipolarRays rays;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    const int begin = edges.begin[chain];
    const int count = edges.begin[chain + 1] - begin - static_cast<int>(chain % 4);
    rays.Compute(pair.ReferenceHomography(), &edges.tokens[begin], count);
    for (int k = 0; k < count; ++k)
    {
      const EdgeToken& token = edges.tokens[begin + k];
      const EpipolarPair::Ray ray = pair.FromReference(token.position);
      EXPECT_NEAR(rays.u[k], ray.u, 1e-9);
      EXPECT_NEAR(rays.v[k], ray.v, 1e-9);
      EXPECT_NEAR(rays.scale[k], ray.scale, 1e-12);
      const Eigen::Matrix2d jacobian = pair.ReferenceJacobian(ray);
      const Eigen::Vector2d tangent = (jacobian * token.tangent).normalized();
      const Eigen::Vector2d across = jacobian * token.Normal();
      EXPECT_NEAR((Eigen::Vector2d(rays.tangentU[k], rays.tangentV[k]) - tangent).norm(), 0, 1e-12);
      EXPECT_NEAR((Eigen::Vector2d(rays.acrossU[k], rays.acrossV[k]) - across).norm(), 0, 1e-9);
    }
  }
}
