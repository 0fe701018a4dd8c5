// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GlobalShift_h
#define freespace_GlobalShift_h

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <string_view>

namespace freespace
{

/// The global shift of a file: an offset that is subtracted from all of its coordinates, so that single
/// precision suffices for a scene far from the origin, as in UTM coordinates. The file tells it, as a comment or
/// otherwise, and readers add it again.

/// Whether single precision rounds the coordinates in a box by less than 1e-5 of its diagonal.
bool SufficesSingle(const Eigen::AlignedBox3d& box);

/// Zero where single precision suffices; otherwise the middle of the box, rounded to a power of ten that is
/// no smaller than its diagonal.
Eigen::Vector3d SuggestGlobalShift(const Eigen::AlignedBox3d& box);

/// In one line: "global shift 500000 5400000 0". Every digit is kept. Empty for zero.
std::string GlobalShiftComment(const Eigen::Vector3d& shift);

/// The shift of such a comment; nothing for any other.
std::optional<Eigen::Vector3d> GlobalShiftFromComment(std::string_view comment);

}

#endif
