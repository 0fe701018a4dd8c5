// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RandomCameras_h
#define freespace_RandomCameras_h

#include "Edges/EdgeTokens.h"
#include "Support/SyntheticImages.h"

#include <cmath>
#include <random>

namespace freespace
{

/// Cameras near the origin that look about along z.
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

/// Chains that wander over the image.
inline EdgeChains RandomChainsOf(RandomCameras& random, int count)
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

#endif
