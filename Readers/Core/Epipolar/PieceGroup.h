// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PieceGroup_h
#define freespace_PieceGroup_h

namespace freespace
{

/// Pieces of chains in a row of an EpipolarIndex, as a structure of arrays for vectorization.
struct PieceGroup
{
  static constexpr int Size = 16; ///< GCC unrolls shorter loops instead of vectorizing them

  float low[Size], high[Size]; ///< rows between which a piece lies: [low, high)
  float u[Size];               ///< where it crosses the row's upper border
  float slope[Size];           ///< du / dv
  float tangentU[Size], tangentV[Size];
  float width[Size]; ///< how far its crossing moves when the edge moves
  int token[Size];   ///< where it starts
};

/// What to look for in a row.
struct EdgeSearch
{
  float near, far;          ///< columns [near, far)
  float tangentU, tangentV; ///< of the edge
  float minimumCosine;      ///< of the angle to it
};

/// And where the row is.
struct RowSearch
{
  EdgeSearch edge;
  float row;
  float down; ///< from the upper border of the groups' row
};

/// Where a piece crosses the row that is searched.
struct PieceCrossing
{
  int token;
  float u, cosine, width;
};

/// Finds the pieces [begin, end), counted from the first group's first one, that cross the row as the search wants.
/// Writes them in their order and returns how many there are.
int FindCrossings(
  const PieceGroup* groups, int begin, int end, const RowSearch& search, PieceCrossing* found);

}

#endif
