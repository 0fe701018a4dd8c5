// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MetashapeModel_h
#define freespace_MetashapeModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads the cameras that Agisoft Metashape exports as XML: cameras only, no points. Sensors are of the type
/// frame or fisheye (f cx cy b1 k1 k2 k3 k4 p1 p2; k4 of fisheyes only, and no b2). Cameras that are not
/// aligned or not enabled are left out. Coordinates are those of the chunk, without its transform, which is
/// to the Earth's centre. Images have a camera's label for a name; where it has no extension it is that
/// of the file beside the XML or in a folder `images` beside it.
///
/// Throws Error naming the file, line and fault.
SparseModel ReadMetashapeModel(const std::string& file);

}

#endif
