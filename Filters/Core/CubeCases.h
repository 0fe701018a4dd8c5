// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CubeCases_h
#define freespace_CubeCases_h

#include <array>
#include <vector>

namespace freespace
{

/// The 256 cases of marching cubes, derived instead of tabulated, so that what they guarantee can
/// be read off.
///
/// Corner c of a cube is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 * axis + i runs along the axis
/// from corner Begin[edge]. Case bits are set for corners in matter.
///
/// On every face of a cube, each run of matter corners is cut off by one segment: on a face with
/// two opposite matter corners they stay apart, unless it is joined. The two cubes beside a face see the same corners
/// and so the same segments; the segments of a cube close to loops. Each loop is a fan of triangles
/// about an apex from which no diagonal lies on a face of the cube (there always is one). Hence the
/// surface of any lattice is closed and 2-manifold, also at ambiguous faces, and with vertices
/// strictly inside of their edges it does not meet itself; TestCubeCases tries all cases for that.
class CubeCases
{
public:
  /// A closed polygon over the cube's edges, seen from the free side counter-clockwise. Its fan's
  /// apex comes first.
  using Loop = std::vector<int>;

  static const CubeCases& Get();

  static constexpr int NoFace = -1;

  /// The loops of a case; with a joined face (see CanJoin), the matter hangs together across it.
  const std::vector<Loop>& Loops(int matterCorners, int joinedFace = NoFace) const
  {
    return this->Cases[matterCorners][1 + joinedFace];
  }

  int NumberOfTriangles(int matterCorners, int joinedFace = NoFace) const
  {
    return this->Triangles[matterCorners][1 + joinedFace];
  }

  /// Whether a face is ambiguous and may be joined without the cube's triangles meeting, wherever its
  /// vertices are. It must be joined in both of its cubes.
  bool CanJoin(int matterCorners, int face) const
  {
    return !this->Cases[matterCorners][1 + face].empty();
  }

  /// The face that can be joined, where it is the cube's only ambiguous one; otherwise NoFace.
  int OnlyJoinableFace(int matterCorners) const { return this->Joinable[matterCorners]; }

  /// The corner where an edge begins; it ends at Begin + (1 << edge / 4).
  static int Begin(int edge)
  {
    // The edge's two bits are the places on the two other axes, in their order.
    const int axis = edge >> 2, first = edge & 1, second = edge >> 1 & 1;
    return axis == 0 ? first << 1 | second << 2
      : axis == 1    ? first | second << 2
                     : first | second << 1;
  }

  /// The face that two edges of a loop, one after the other, share: 2 * axis, and 1 more for the upper
  /// one.
  static int CommonFace(int edgeA, int edgeB);

  /// Whether two lines cross a face.
  static bool IsAmbiguous(int matterCorners, int face);

private:
  CubeCases();
  void MakeLoops(int matterCorners, int joinedFace);

  std::array<std::array<std::vector<Loop>, 7>, 256> Cases; ///< without and with each joined face
  std::array<std::array<int, 7>, 256> Triangles;
  std::array<int, 256> Joinable;
};

}

#endif
