// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PointHash_h
#define freespace_PointHash_h

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace freespace
{

/// For tables of points by their exact coordinates.
struct PointHash
{
  std::size_t operator()(const Eigen::Vector3d& point) const
  {
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double coordinate = point[i] + 0.0; // -0 equals 0
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof(bits));
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

}

#endif
