// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AliceVisionModel_h
#define freespace_AliceVisionModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads AliceVision's (Meshroom's) .sfm file of JSON: views, intrinsics (pinhole, radial1, radial3, brown,
/// fisheye4, fisheye1), poses and the structure, of versions 1.0 to 1.2. Views without a pose are left out.
///
/// Throws Error naming the file, place and fault.
SparseModel ReadAliceVisionModel(const std::string& file);

}

#endif
