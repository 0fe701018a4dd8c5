// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RemainingImages_h
#define freespace_RemainingImages_h

#include "Scene/Scene.h"

#include <set>
#include <string>

namespace freespace
{

/// The model without these images.
SparseModel WithoutImages(SparseModel model, const std::set<std::string>& names);

/// The scene with these images in none of its clusters. The remaining images of a cluster stay together:
/// a reference is matched with those that are left on either side, and where the reference itself is
/// gone, the first of the others that is no reference yet takes its place. Clusters of fewer than three
/// images are gone.
Scene WithoutImages(Scene scene, const std::set<std::string>& names);

}

#endif
