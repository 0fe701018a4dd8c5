// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalMixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A strip of triangles, whose normals and areas are random.
struct RandomStrip
{
  explicit RandomStrip(unsigned int seed, int count = 203)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int t = 0; t < count; ++t)
    {
      this->Triangles.push_back({ t + t % 2, t + 1 - t % 2, t + 2 });
      this->Normals.push_back(Vector3d(0.5 * number(random), 0.5 * number(random), 1).normalized());
      this->Guides.push_back((this->Normals.back() + Vector3d(0, 0.1 * number(random), 0)));
      this->Areas.push_back(1.5 + number(random));
    }
  }

  MeshEdges Edges() const { return MeshEdges(this->Triangles, this->Triangles.size() + 2); }

  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<Vector3d> Normals, Guides;
  std::vector<double> Areas;
};

Vector3d At(const NormalMixer::Normals& normals, std::size_t t)
{
  return { normals[0][t], normals[1][t], normals[2][t] };
}

}

TEST(NormalMixer, IsTheWeightedAverageOfTheNeighbors)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    const RandomStrip strip(seed);
    const MeshEdges edges = strip.Edges();
    constexpr double deviation = 0.2;
    NormalMixer::Normals mixed;
    NormalMixer(strip.Areas, edges)
      .Mix(NormalMixer::FromVectors(strip.Normals), NormalMixer::FromVectors(strip.Guides),
        deviation, mixed, SerialFor);
    for (std::size_t t = 0; t < strip.Normals.size(); ++t)
    {
      Vector3d sum = strip.Areas[t] * strip.Normals[t];
      for (const int other : edges.opposite[t])
      {
        if (other >= 0)
        {
          const double squared = (strip.Guides[t] - strip.Guides[other]).squaredNorm();
          const double similar = std::max(0.0, 1 - squared / (6 * deviation * deviation));
          sum += std::pow(similar, 3) * strip.Areas[other] * strip.Normals[other];
        }
      }
      EXPECT_LT((At(mixed, t) - sum.normalized()).norm(), 2e-6) << "seed " << seed << ", " << t;
    }
  }
}

TEST(NormalMixer, IsTheSameForEachPartOfTheTriangles)
{
  const RandomStrip strip(1);
  const NormalMixer mixer(strip.Areas, strip.Edges());
  const auto normals = NormalMixer::FromVectors(strip.Normals);
  const ParallelFor inParts = [](std::size_t count, const auto& body)
  {
    for (std::size_t begin = 0; begin < count; begin += 7)
    {
      body(begin, std::min(count, begin + 7));
    }
  };
  NormalMixer::Normals whole, parts;
  mixer.Mix(normals, normals, 0.3, whole, SerialFor);
  mixer.Mix(normals, normals, 0.3, parts, inParts);
  EXPECT_EQ(whole, parts);
}

TEST(NormalMixer, LeavesNormalsWhoseAverageIsZero)
{
  const std::vector<Vector3d> opposite = { { 0, 0, 1 }, { 0, 0, -1 } };
  const std::vector<Vector3d> same = { { 0, 0, 1 }, { 0, 0, 1 } };
  const MeshEdges edges({ { 0, 1, 2 }, { 2, 1, 3 } }, 4);
  NormalMixer::Normals mixed;
  const auto normals = NormalMixer::FromVectors(opposite), guides = NormalMixer::FromVectors(same);
  for (const std::vector<double>& areas : { std::vector<double>{ 1, 1 }, { 0, 0 } })
  {
    NormalMixer(areas, edges).Mix(normals, guides, 0.3, mixed, SerialFor);
    EXPECT_EQ(mixed, normals);
  }
}

TEST(NormalMixer, TakesNoTriangles)
{
  NormalMixer::Normals mixed;
  const auto none = NormalMixer::FromVectors({});
  NormalMixer({}, MeshEdges({}, 0)).Mix(none, none, 0.3, mixed, SerialFor);
  EXPECT_EQ(mixed[0].size(), 1u);
}
