// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ScaledImages_h
#define freespace_ScaledImages_h

#include "Scene/Scene.h"

#include <string>

namespace freespace
{

/// The camera of images that are larger or smaller by these factors: width and height, focal lengths and
/// principal point are scaled, the distortion is of normalized coordinates and stays. To the nearest whole
/// pixel, each direction by itself where the model has two focal lengths.
SparseCamera ScaledCamera(const SparseCamera& camera, int width, int height);

/// Gives each image of the model whose file exists, in another size than its camera's, a scaled
/// camera; its observations are scaled, too. Only where width and height are scaled alike, to the rounding
/// of a pixel: an image of another shape has been cropped or rotated, and is an error when it is read.
///
/// Returns in a sentence how many were scaled and by how much; empty when none was.
std::string ScaleToPhotographs(const Scene& scene, SparseModel& model);

}

#endif
