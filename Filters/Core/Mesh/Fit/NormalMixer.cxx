// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalMixer.h"

#include "Common/VectorClones.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// What Mix reads and writes, of all triangles.
struct MixArrays
{
  const float *x, *y, *z;
  const float *guideX, *guideY, *guideZ;
  const float* areas;
  const std::int32_t* beside[3];
  float scale;
  float *mixedX, *mixedY, *mixedZ;
};

FREESPACE_VECTOR_CLONES
void MixRange(const MixArrays& all, std::size_t begin, std::size_t end)
{
  const MixArrays a = all;
#pragma GCC ivdep
  for (std::size_t t = begin; t < end; ++t)
  {
    float x = a.areas[t] * a.x[t], y = a.areas[t] * a.y[t], z = a.areas[t] * a.z[t];
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t other = a.beside[k][t];
      const float dx = a.guideX[t] - a.guideX[other];
      const float dy = a.guideY[t] - a.guideY[other];
      const float dz = a.guideZ[t] - a.guideZ[other];
      const float near = 1 - a.scale * (dx * dx + dy * dy + dz * dz);
      const float similar = near > 0 ? near : 0;
      const float weight = similar * similar * similar * a.areas[other];
      x += weight * a.x[other];
      y += weight * a.y[other];
      z += weight * a.z[other];
    }
    const float squared = x * x + y * y + z * z;
    const float inverse = 1 / std::sqrt(squared);
    a.mixedX[t] = squared > 0 ? inverse * x : a.x[t];
    a.mixedY[t] = squared > 0 ? inverse * y : a.y[t];
    a.mixedZ[t] = squared > 0 ? inverse * z : a.z[t];
  }
}

}

NormalMixer::NormalMixer(const std::vector<double>& areas, const MeshEdges& edges)
{
  const double unit = areas.empty() ? 1 : *std::max_element(areas.begin(), areas.end());
  this->Areas.reserve(areas.size() + 1);
  for (const double area : areas)
  {
    this->Areas.push_back(static_cast<float>(unit > 0 ? area / unit : 0));
  }
  this->Areas.push_back(0);
  const auto beyond = static_cast<std::int32_t>(areas.size());
  for (int k = 0; k < 3; ++k)
  {
    this->Beside[k].reserve(areas.size());
    for (const auto& opposite : edges.opposite)
    {
      this->Beside[k].push_back(opposite[k] >= 0 ? opposite[k] : beyond);
    }
  }
}

NormalMixer::Normals NormalMixer::FromVectors(const std::vector<Eigen::Vector3d>& normals)
{
  Normals arrays;
  for (int k = 0; k < 3; ++k)
  {
    arrays[k].reserve(normals.size() + 1);
    for (const Eigen::Vector3d& normal : normals)
    {
      arrays[k].push_back(static_cast<float>(normal[k]));
    }
    arrays[k].push_back(0);
  }
  return arrays;
}

void NormalMixer::Mix(const Normals& normals, const Normals& guides, double deviation,
  Normals& mixed, const ParallelFor& parallelFor) const
{
  for (std::vector<float>& coordinate : mixed)
  {
    coordinate.resize(this->Areas.size(), 0);
  }
  const MixArrays arrays{ normals[0].data(), normals[1].data(), normals[2].data(), guides[0].data(),
    guides[1].data(), guides[2].data(), this->Areas.data(),
    { this->Beside[0].data(), this->Beside[1].data(), this->Beside[2].data() },
    static_cast<float>(1 / (6 * deviation * deviation)), mixed[0].data(), mixed[1].data(),
    mixed[2].data() };
  parallelFor(this->Areas.size() - 1,
    [&](std::size_t begin, std::size_t end) { MixRange(arrays, begin, end); });
}

}
