// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NvmModel_h
#define freespace_NvmModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads the first (largest) model of VisualSFM's .nvm file, version NVM_V3.
///
/// Its pixels are counted from the middle of the image, or as COLMAP exports it from the upper left corner;
/// sizes of images are found as UnsizedModel finds them, images relative to the .nvm file. Its one
/// coefficient r of radial distortion maps measured to undistorted coordinates, u = m (1 + r |m|^2) with m
/// in units of the focal length. It is turned into the first three coefficients of the inverse series,
/// which leaves a relative error of 55 (r |u|^2)^4. COLMAP writes its SIMPLE_RADIAL's -k1 for r: that
/// lens is taken where pixels are counted from the corner.
///
/// A fixed calibration in the first line, FixedK fx cx fy cy, holds for all images: their pixels are
/// counted from (cx, cy).
///
/// Throws Error naming the file, line and fault.
SparseModel ReadNvmModel(const std::string& file);

}

#endif
