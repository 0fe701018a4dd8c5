// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeStore_h
#define freespace_EdgeStore_h

#include "Edges/EdgeTokens.h"
#include "Images/ImageCache.h"
#include "Scene/Scene.h"

#include <cstddef>
#include <memory>

namespace freespace
{

/// The edges of a scene's images outside of their masks, freed of the lens's distortion. An image
/// belongs to several clusters and to the refinement of the cameras: its edges are found once and kept, as
/// far as memory allows. Thread-safe.
class EdgeStore
{
public:
  /// Keeps the most recently used edges, up to `mostTokens` tokens (of 72 bytes).
  EdgeStore(const Scene& scene, const EdgeTokenOptions& options,
    std::size_t mostTokens = std::size_t(1) << 24);

  /// The edges of an image where a camera without distortion would see them. They depend on its
  /// intrinsics, not on its pose. Throws Error naming the file: missing, unreadable or of another size
  /// than the camera's.
  std::shared_ptr<const EdgeChains> Edges(const CalibratedImage& image);

private:
  EdgeChains Find(const CalibratedImage& image) const;

  Scene Source; // for its folders
  EdgeTokenOptions Options;
  ImageCache<EdgeChains> Cache;
};

}

#endif
