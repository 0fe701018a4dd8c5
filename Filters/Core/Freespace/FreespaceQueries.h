// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FreespaceQueries_h
#define freespace_FreespaceQueries_h

#include "Freespace/FreespaceUnion.h"

namespace freespace
{

/// The applications that the paper's last page proposes for Phi: "obstacle avoidance and ray
/// tracing". All functions are safe to call from several threads. They fail closed: a number that is
/// not finite, a negative radius or an empty box is not free.

/// Whether a point lies in free space.
bool IsPointFree(const FreespaceUnion& phi, const Eigen::Vector3d& point);

/// What is known of a point.
enum class PointState : unsigned char
{
  Matter,
  Free,   ///< seen, by as many views as must agree
  Unknown ///< outside of the hull and never seen, or not finite
};

PointState StateOf(const FreespaceUnion& phi, const Eigen::Vector3d& point);

/// The first place where a segment is not in free space, as a fraction of its length: 0 when it
/// begins in matter, infinite when all of it is free. Exact. Matter is closed: a segment that only
/// touches it is blocked there.
double FirstBlocked(
  const FreespaceUnion& phi, const Eigen::Vector3d& first, const Eigen::Vector3d& last);

/// Whether a closed box is wholly in free space. True is certain. False can also mean that matter
/// is closer to the box than about a thousandth of its longest side, or that the free spaces of two
/// views meet in the box, so that neither contains all of a part of that size.
bool IsBoxFree(const FreespaceUnion& phi, const Eigen::AlignedBox3d& box);

/// The same for a closed ball.
bool IsSphereFree(const FreespaceUnion& phi, const Eigen::Vector3d& center, double radius);

}

#endif
