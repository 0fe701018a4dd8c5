// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BundlerModel_h
#define freespace_BundlerModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads Bundler's bundle.out, version 0.3: cameras with two coefficients of radial distortion that
/// look along their -z axis, y up, the origin of pixels in the middle of the image.
///
/// The file names no images and does not know their size. Names are taken from a list.txt beside it
/// or in the folder above, else they are image0, image1, ... Sizes are those of the photographs
/// where they are found relative to the list, else the smallest that hold all observations of the
/// image. A camera with focal length 0, which Bundler did not place, is left out.
///
/// Throws Error naming the file, line and fault.
SparseModel ReadBundlerModel(const std::string& file);

}

#endif
