// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ScaledImages_h
#define freespace_ScaledImages_h

#include "Scene/Scene.h"

#include <string>

namespace freespace
{

/// The camera of photographs that are so much larger or smaller: width and height, focal lengths and
/// principal point are scaled, the distortion is of normalized coordinates and stays. To the nearest whole
/// pixel, each direction by itself where the model has two focal lengths.
SparseCamera ScaledCamera(const SparseCamera& camera, int width, int height);

/// Gives each image of the model whose photograph is there, in another size than its camera's, a scaled
/// camera; its observations are scaled, too. Only where width and height are scaled alike, to the rounding
/// of a pixel: a picture of another shape has been cut or turned, and is told as an error when it is read.
///
/// Returns in a sentence how many were scaled and by how much; empty when none was.
std::string ScaleToPhotographs(const Scene& scene, SparseModel& model);

}

#endif
