// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeHypothesis_h
#define freespace_EdgeHypothesis_h

namespace freespace
{

/// A token of another image that may show the same edge as a token of the reference.
struct EdgeCandidate
{
  double disparity; ///< 1 / depth in the reference camera
  float sigma;      ///< error of the disparity when the other edge is off by one pixel across
  float shift;      ///< change of the disparity when the reference's token moves one pixel across
  float cost;       ///< [0, 1)
  int image;
  int token;

  /// The weight of its disparity in a mean: the inverse variance.
  double Weight() const { return 1 / (static_cast<double>(this->sigma) * this->sigma); }
};

/// Candidates of different images that agree in their disparity: the elements [begin, begin + count) of
/// a separate list of support. An empty hypothesis means no match.
struct EdgeHypothesis
{
  double disparity = 0;
  float sigma = 0; ///< its error when the edges are off by one pixel across
  float score = 0; ///< the lower the better, 0 for no match
  int begin = 0;
  int count = 0;
  bool promising = false; ///< a third image almost confirms it

  double Weight() const { return 1 / (static_cast<double>(this->sigma) * this->sigma); }
  bool Empty() const { return this->count == 0; }

  /// By a third image.
  bool Confirmed() const { return this->count >= 2; }
};

}

#endif
