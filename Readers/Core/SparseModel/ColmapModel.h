// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ColmapModel_h
#define freespace_ColmapModel_h

#include "SparseModel/SparseModel.h"

#include <string>

namespace freespace
{

/// Reads a COLMAP model from a folder: cameras, images and points3D, all as .bin or all as .txt.
/// Where both are there the binary ones are read, as COLMAP does. Without a points3D file the model
/// has no points. The rigs and frames that COLMAP writes from 3.12 on are not needed: images have their poses
/// all the same. In a text file the line of observations may be left out where there are none.
///
/// Throws Error, naming the file, the line of a text file and the fault: a missing or truncated
/// file, a malformed line, a number that is not finite or out of range, a camera model that is not
/// supported, two cameras, images or points with one id, an image with an unknown camera.
SparseModel ReadColmapModel(const std::string& folder);

enum class ColmapFormat
{
  Text,
  Binary
};

/// Writes cameras, images and points3D into a folder, which is created if only its last part is
/// missing. Numbers in text files have the digits needed to read the same number again.
/// The three files are made in a folder of their own and then renamed; files of the other format,
/// which could hold another model, are removed, and so are rigs and frames of an older one. Throws Error if
/// the folder cannot be written.
void WriteColmapModel(const SparseModel& model, const std::string& folder, ColmapFormat format);

}

#endif
