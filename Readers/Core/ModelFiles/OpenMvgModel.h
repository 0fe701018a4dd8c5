// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OpenMvgModel_h
#define freespace_OpenMvgModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads OpenMVG's sfm_data.json: views with intrinsics (pinhole, pinhole_radial_k1, pinhole_radial_k3,
/// pinhole_brown_t2, fisheye) and extrinsics, and the structure. Views without a pose are left out.
///
/// Throws Error naming the file, place and fault.
SparseModel ReadOpenMvgModel(const std::string& file);

}

#endif
