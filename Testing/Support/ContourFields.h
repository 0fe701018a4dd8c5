// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourFields_h
#define freespace_ContourFields_h

#include "Common/ParallelFor.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourOptions.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace freespace
{

/// Matter is the unit ball.
class Ball : public ContourField
{
public:
  bool IsFree(const Eigen::Vector3d& point, const FieldScope&) const override
  {
    return point.norm() > 1.0;
  }
};

/// Matter or free by a coin for each lattice point: every case of the cubes, side by side.
class Noise : public ContourField
{
public:
  explicit Noise(unsigned int seed)
    : Seed(seed)
  {
  }
  bool IsFree(const Eigen::Vector3d& point, const FieldScope&) const override
  {
    const auto cell = [](double x)
    { return static_cast<std::uint64_t>(std::floor(x * 16 + 1000)); };
    std::uint64_t h = this->Seed;
    for (double x : { point.x(), point.y(), point.z() })
    {
      h = (h ^ cell(x)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return h >> 11 & 1;
  }

private:
  std::uint64_t Seed;
};

/// A cube around the origin.
inline Eigen::AlignedBox3d Cube(double half)
{
  return Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half));
}

/// Default options but for the number of cells, without sharp edges.
inline ContourOptions Cells(int cells)
{
  ContourOptions options;
  options.cells = cells;
  options.sharp = false;
  return options;
}

/// A ParallelFor with three threads.
inline void ThreeThreads(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
  {
    threads.emplace_back([&body, count, i] { body(count * i / 3, count * (i + 1) / 3); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

}

#endif
