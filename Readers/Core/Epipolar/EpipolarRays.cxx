// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarRays.h"

#include "Common/VectorClones.h"

#include <cmath>

namespace freespace
{

namespace
{

FREESPACE_VECTOR_CLONES
void Rectify(const double* h, const double* x, const double* y, int count, double* __restrict u,
  double* __restrict v, double* __restrict scale)
{
  for (int k = 0; k < count; ++k)
  {
    const double depth = h[2] * x[k] + h[5] * y[k] + h[8];
    const double inverse = 1 / depth;
    u[k] = (h[0] * x[k] + h[3] * y[k] + h[6]) * inverse;
    v[k] = (h[1] * x[k] + h[4] * y[k] + h[7]) * inverse;
    scale[k] = depth;
  }
}

// How a rectified pixel moves with its own, which goes along (x, y)[k].
FREESPACE_VECTOR_CLONES
void Move(const double* h, const double* x, const double* y, const double* u, const double* v,
  const double* scale, int count, double* __restrict alongU, double* __restrict alongV)
{
  for (int k = 0; k < count; ++k)
  {
    const double inverse = 1 / scale[k];
    const double deeper = h[2] * x[k] + h[5] * y[k];
    alongU[k] = (h[0] * x[k] + h[3] * y[k] - u[k] * deeper) * inverse;
    alongV[k] = (h[1] * x[k] + h[4] * y[k] - v[k] * deeper) * inverse;
  }
}

FREESPACE_VECTOR_CLONES
void Normalize(double* __restrict x, double* __restrict y, int count)
{
  for (int k = 0; k < count; ++k)
  {
    const double inverse = 1 / std::sqrt(x[k] * x[k] + y[k] * y[k]);
    x[k] *= inverse;
    y[k] *= inverse;
  }
}

}

void EpipolarRays::Compute(const Eigen::Matrix3d& homography, const EdgeToken* tokens, int count)
{
  std::vector<double>&x = this->X, &y = this->Y;
  for (std::vector<double>* row : { &x, &y, &this->u, &this->v, &this->scale, &this->tangentU,
         &this->tangentV, &this->acrossU, &this->acrossV })
  {
    row->resize(count);
  }
  const double* h = homography.data(); // column by column
  for (int k = 0; k < count; ++k)
  {
    x[k] = tokens[k].position.x();
    y[k] = tokens[k].position.y();
  }
  Rectify(h, x.data(), y.data(), count, this->u.data(), this->v.data(), this->scale.data());
  const auto move = [&](std::vector<double>& alongU, std::vector<double>& alongV)
  {
    Move(h, x.data(), y.data(), this->u.data(), this->v.data(), this->scale.data(), count,
      alongU.data(), alongV.data());
  };
  for (int k = 0; k < count; ++k)
  {
    x[k] = tokens[k].tangent.x();
    y[k] = tokens[k].tangent.y();
  }
  move(this->tangentU, this->tangentV);
  Normalize(this->tangentU.data(), this->tangentV.data(), count);
  for (int k = 0; k < count; ++k)
  {
    const Eigen::Vector2d normal = tokens[k].Normal();
    x[k] = normal.x();
    y[k] = normal.y();
  }
  move(this->acrossU, this->acrossV);
}

}
