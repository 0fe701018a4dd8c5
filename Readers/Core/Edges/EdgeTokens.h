// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeTokens_h
#define freespace_EdgeTokens_h

#include "Edges/LargeVector.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cv
{
class Mat;
}

namespace freespace
{

/// How edges are found in one image.
struct EdgeTokenOptions
{
  double smoothing = 1.0;    ///< sigma of the Gaussian before the derivative, pixels; > 0
  double lowContrast = 1.8;  ///< least slope of an edge at middle grey, grey levels per pixel; > 0;
                             ///< as the noise, it is less in the dark and more in the light
  double highContrast = 4.5; ///< slope that an edge chain reaches somewhere; >= lowContrast
  int minimumLength = 6;     ///< of a chain, tokens; > 0
  int fitRadius = 4;         ///< tokens to either side that a token's position and tangent are
                             ///< fitted to by a parabola; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// A colour: blue, green, red and a zero, so that processors take it at once.
using EdgeColor = std::array<std::uint8_t, 4>;

/// What an edge looks like on one side: its colours at four distances from it.
using EdgeSide = std::array<EdgeColor, 4>;

/// A piece of an image edge, about one pixel long.
struct EdgeToken
{
  Eigen::Vector2d position; ///< pixels, the centre of the first one at (0.5, 0.5)
  Eigen::Vector2d tangent;  ///< unit length, in the direction of the chain; the brighter side lies
                            ///< towards Normal(), to the right as one walks along the chain
  float contrast = 0;       ///< slope of the grey levels across the edge, per pixel, in the noise
                            ///< of middle grey
  EdgeSide bright; ///< colours 1.5, 2.5, 3.5 and 5 pixels from the edge on its brighter side
  EdgeSide dark;   ///< and on the darker one
  EdgeColor color; ///< at the edge itself

  Eigen::Vector2d Normal() const { return { -this->tangent.y(), this->tangent.x() }; }

  /// Error of the position across the edge, in units of that of a strong edge: noise shifts a
  /// faint one more.
  double Uncertainty() const { return std::sqrt(1 + 9 / (this->contrast * this->contrast)); }
};

/// The edges of an image, linked. Chain c consists of the tokens [begin[c], begin[c + 1]) in order.
struct EdgeChains
{
  LargeVector<EdgeToken> tokens;
  std::vector<int> begin = { 0 };

  std::size_t NumberOfChains() const { return this->begin.size() - 1; }

  /// Distance between two tokens, pixels.
  double Distance(int from, int to) const
  {
    return (this->tokens[to].position - this->tokens[from].position).norm();
  }
};

/// Canny's edges with Devernay's sub-pixel correction: the position is the vertex of the parabola
/// through three gradient magnitudes across the edge, refined along the linked chain. The image has 8
/// bits, one or three channels.
EdgeChains FindEdges(const cv::Mat& image, const EdgeTokenOptions& options);

}

#endif
