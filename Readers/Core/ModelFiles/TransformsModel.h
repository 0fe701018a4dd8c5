// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TransformsModel_h
#define freespace_TransformsModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads a transforms.json of nerfstudio or instant-ngp: cameras only, no points.
///
/// Each frame has a `file_path` relative to the file (without an extension it is a .png, as in Blender's
/// data) and a `transform_matrix` from camera to world, the camera looking along -z, y up. The lens is in
/// the file or in the frame: fl_x fl_y cx cy w h or camera_angle_x, with `camera_model` OPENCV, PINHOLE,
/// SIMPLE_PINHOLE, OPENCV_FISHEYE or instant-ngp's `is_fisheye`, and k1 k2 k3 k4 p1 p2. Where w and h are
/// missing the images have them. An `applied_transform`, by which nerfstudio has turned the world of the model
/// that it converted, is undone: the cameras are those of that model.
///
/// Throws Error naming the file, place and fault.
SparseModel ReadTransformsModel(const std::string& file);

}

#endif
