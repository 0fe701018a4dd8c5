// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TrackBytes_h
#define freespace_TrackBytes_h

#include "Refinement/EdgeTracks.h"

namespace freespace
{

/// Tracks for ByteWriter and ByteReader.
template <typename Bytes>
void Exchange(Bytes& bytes, EdgeObservation& observation)
{
  bytes(observation.image, observation.position, observation.normal, observation.uncertainty);
}

template <typename Bytes>
void Exchange(Bytes& bytes, EdgeTrack& track)
{
  bytes(track.point, track.observations);
}

}

#endif
