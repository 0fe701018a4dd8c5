// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/PieceGroup.h"

#include "Common/VectorClones.h"

#include <cmath>

namespace freespace
{

FREESPACE_VECTOR_CLONES
int FindCrossings(
  const PieceGroup* groups, int begin, int end, const RowSearch& search, PieceCrossing* found)
{
  constexpr int size = PieceGroup::Size;
  static constexpr unsigned int bits[size] = { 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048,
    4096, 8192, 16384, 32768 };
  const EdgeSearch edge = search.edge;
  const float row = search.row, down = search.down;
  int count = 0;
  for (int first = begin / size * size; first < end; first += size)
  {
    const PieceGroup& group = groups[first / size];
    float columns[size], cosines[size];
    unsigned int crossing = 0;
    for (int k = 0; k < size; ++k)
    {
      columns[k] = group.u[k] + down * group.slope[k];
      cosines[k] = std::abs(edge.tangentU * group.tangentU[k] + edge.tangentV * group.tangentV[k]);
      const bool isWanted = (group.low[k] <= row) & (row < group.high[k]) &
        (columns[k] >= edge.near) & (columns[k] < edge.far) & (cosines[k] >= edge.minimumCosine);
      crossing |= isWanted ? bits[k] : 0;
    }
    crossing &= first < begin ? ~0u << (begin - first) : ~0u;
    crossing &= first + size > end ? ~(~0u << (end - first)) : ~0u;
    for (int k = 0; crossing != 0; ++k, crossing >>= 1)
    {
      if (crossing & 1)
      {
        found[count++] = { group.token[k], columns[k], cosines[k], group.width[k] };
      }
    }
  }
  return count;
}

}
