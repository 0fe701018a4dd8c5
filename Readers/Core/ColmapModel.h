// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ColmapModel_h
#define freespace_ColmapModel_h

#include "SparseModel.h"

#include <string>

namespace freespace
{

/// Reads a COLMAP model from a folder: cameras, images and points3D, all as .bin or all as .txt.
/// Where both are there the binary ones are read, as COLMAP does. Without a points3D file the model
/// has no points.
///
/// Throws Error, naming the file, the line of a text file and the fault: a missing or truncated
/// file, a malformed line, a number that is not finite or out of range, a camera model that is not
/// supported, two cameras, images or points with one id, an image with an unknown camera.
SparseModel ReadColmapModel(const std::string& folder);

}

#endif
