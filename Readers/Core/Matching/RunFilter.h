// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RunFilter_h
#define freespace_RunFilter_h

#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"

namespace freespace
{

/// Takes back the matches of short runs that stand alone: most tokens of a run of less than 20 must have
/// a match of another, accepted run in the image around them whose disparity a surface could
/// continue to theirs. A wrong match that is consistent in itself is about as likely at any depth, and
/// a single one, far behind the scene, makes a wedge of free space through everything before it.
/// `baseline`: see EpipolarPair, of the longest pair.
void DropLonelyRuns(const EdgeChains& edges, double baseline, const MatcherOptions& options,
  LargeVector<EdgeMatch>& matches);

}

#endif
