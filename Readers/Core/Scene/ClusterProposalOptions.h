// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ClusterProposalOptions_h
#define freespace_ClusterProposalOptions_h

namespace freespace
{

/// Criteria for the neighbours of edge stereo and for the choice of references. Lengths are measured as
/// angles at the scene, so that no field has a unit of length.
struct ClusterProposalOptions
{
  double preferredAngle = 5.0; ///< between the rays of a neighbour and the reference, degrees
  double minimumAngle = 1.0;   ///< below it depth is too uncertain, degrees; > 0
  double maximumAngle = 30.0;  ///< above it the images differ too much, degrees
  double minimumOverlap = 0.4; ///< fraction of the reference's image that a neighbour sees too
  int neighbors = 4;           ///< of a reference at most, 2 or 4
  double separation = 5.0;     ///< of two references seen from the scene, degrees: nearer ones have
                               ///< the same free space; 0 makes every possible image a reference
  int coverage = 3; ///< an image is not needed when this number of references, none farther from
                    ///< it than coverageAngle, see most of what it sees; 0: no limit
  double coverageAngle = 20.0; ///< degrees
  int smallSet = 24;           ///< with at most this number of possible references, coverage is
                               ///< ignored: all of them are worth their time

  /// Throws Error when a field is out of its range.
  void Check() const;
};

}

#endif
