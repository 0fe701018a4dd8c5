// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BundlerModel_h
#define freespace_BundlerModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads Bundler's bundle.out, version 0.3: cameras with two coefficients of radial distortion that
/// look along their -z axis, y up, pixels counted from the middle of the image, or as COLMAP exports it from
/// the lower left corner (UnsizedModel).
///
/// The file names no images and does not know their size. Names are taken from a NAME.list.txt beside
/// NAME.out or NAME.bundle.out, a NAME.out.list.txt, or a list.txt beside it or in the folder above, else
/// they are image0, image1, ... They may have blanks. Images are sought relative to the list. A camera
/// with focal length 0, which Bundler did not place, is left out.
///
/// Throws Error naming the file, line and fault.
SparseModel ReadBundlerModel(const std::string& file);

}

#endif
