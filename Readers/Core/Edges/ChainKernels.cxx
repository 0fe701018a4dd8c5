// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/ChainKernels.h"

#include "Common/VectorClones.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

FREESPACE_VECTOR_CLONES
void AddWeighted(
  const double* values, int count, const double* weights, int radius, double* __restrict sum)
{
  for (int j = -radius; j <= radius; ++j)
  {
    const double weight = weights[j + radius];
    for (int k = 0; k < count; ++k)
    {
      sum[k] += weight * values[k + j];
    }
  }
}

FREESPACE_VECTOR_CLONES
void Directions(const double* x, const double* y, const float* gx, const float* gy, int count,
  double* __restrict unitX, double* __restrict unitY)
{
  for (int k = 0; k < count; ++k)
  {
    const double levelX = gy[k], levelY = -gx[k];
    const bool ahead = x[k] * levelX + y[k] * levelY > 0;
    const double alongX = ahead ? x[k] : levelX, alongY = ahead ? y[k] : levelY;
    const double inverse = 1 / std::sqrt(alongX * alongX + alongY * alongY);
    unitX[k] = alongX * inverse;
    unitY[k] = alongY * inverse;
  }
}

FREESPACE_VECTOR_CLONES
void PixelOffsets(const double* x, const double* y, const double* tx, const double* ty, int count,
  float distance, const ImageLayout& image, int* __restrict offsets)
{
  const int lastColumn = image.columns - 1, lastRow = image.rows - 1, step = image.step;
  for (int k = 0; k < count; ++k)
  {
    const float atX = static_cast<float>(x[k]) - distance * static_cast<float>(ty[k]);
    const float atY = static_cast<float>(y[k]) + distance * static_cast<float>(tx[k]);
    const int column = std::min(std::max(static_cast<int>(atX), 0), lastColumn);
    const int row = std::min(std::max(static_cast<int>(atY), 0), lastRow);
    offsets[k] = row * step + 3 * column;
  }
}

}
