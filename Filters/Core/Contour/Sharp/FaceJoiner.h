// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FaceJoiner_h
#define freespace_FaceJoiner_h

#include "Contour/Lattice/BoundedField.h"
#include "Contour/Sharp/BlockMesh.h"

namespace freespace
{

/// Resolves ambiguous faces: those of which two opposite corners are in matter and two are free.
/// The lattice alone separates the matter there; where the field has matter in the face's middle,
/// it is joined.
class FaceJoiner
{
public:
  FaceJoiner(const BoundedField& field, const BlockMesh& blocks)
    : Field(field)
    , Blocks(blocks)
  {
  }

  /// Finds the faces to join of a block's cells. Both cells of a face get the same result.
  void JoinFaces(BlockPlace& place) const;

private:
  int FacesToJoin(const LatticeIndex& cell, int matter, const FieldScope& scope) const;

  const BoundedField& Field;
  const BlockMesh& Blocks;
};

}

#endif
