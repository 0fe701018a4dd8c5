// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarRays.h"

#include "Support/Core/RandomCameras.h"

#include <gtest/gtest.h>

using namespace freespace;

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
