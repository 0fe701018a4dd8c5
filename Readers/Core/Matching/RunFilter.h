// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RunFilter_h
#define freespace_RunFilter_h

#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"

namespace freespace
{

/// Removes the matches of short runs without support: at least half of the tokens of a run of less than
/// 20 must have a match of another, accepted run close to them in the image, with a disparity that a
/// continuous surface allows. A wrong but consistent match is about equally likely at any depth, and a
/// single one far behind the scene carves a wedge of free space through everything in front of it.
/// `baseline`: see EpipolarPair, of the longest pair.
void DropLonelyRuns(const EdgeChains& edges, double baseline, const MatcherOptions& options,
  LargeVector<EdgeMatch>& matches);

}

#endif
