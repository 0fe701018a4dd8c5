// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PatchOptions_h
#define freespace_PatchOptions_h

namespace freespace
{

/// How patches are aligned, and which of them become features.
struct PatchOptions
{
  bool isOn = true;   ///< whether patches are looked for at all; the paper has edges only
  int radius = 4;     ///< of the square window in the reference image, pixels; in [2, 7]
  int spacing = 6;    ///< of the grid where a view has no feature, pixels; >= 1
  int seedStep = 2;   ///< along an edge without a match, tokens; >= 1
  int iterations = 6; ///< Gauss-Newton, at most; >= 1
  double leastCorrelation = 0.8; ///< of a partner's patch with the reference's; in (0, 1)
  int leastPartners = 2;         ///< that correlate so well; >= 1
  double leastContrast =
    1.0;                  ///< standard deviation of the grey levels in the middle of a window; > 0
  double mostShift = 3.0; ///< how far a patch may move in a partner, pixels; > 0
  double mostDeviation = 0.35; ///< standard deviation along the epipolar line, pixels; > 0
  double mostRoughness = 0.5; ///< of the features around a patch: their standard deviation from its
                              ///< plane, pixels along the epipolar line; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

}

#endif
