// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewBytes_h
#define freespace_ViewBytes_h

#include "Common/DisparityMap.h"

namespace freespace
{

/// Views and maps for ByteWriter and ByteReader.
template <typename Bytes>
void Exchange(Bytes& bytes, Camera& camera)
{
  bytes(camera.K, camera.R, camera.t, camera.width, camera.height);
}

template <typename Bytes>
void Exchange(Bytes& bytes, View& view)
{
  bytes(view.name, view.imageFile, view.camera, view.points, view.imagePoints, view.edges,
    view.deviations);
}

template <typename Bytes>
void Exchange(Bytes& bytes, EdgeView& view)
{
  bytes(static_cast<View&>(view), view.colors, view.edgeDirections, view.matchingCosts,
    view.chainIds, view.chains, view.tokens);
}

template <typename Bytes>
void Exchange(Bytes& bytes, DisparityMap& map)
{
  bytes(static_cast<View&>(map), map.sourceView, map.triangles);
}

}

#endif
