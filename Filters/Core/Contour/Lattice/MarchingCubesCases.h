// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MarchingCubesCases_h
#define freespace_MarchingCubesCases_h

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
class MarchingCubesCases
{
public:
  /// A closed polygon over the cube's edges, seen from the free side counter-clockwise. Its fan's
  /// apex comes first.
  using Loop = std::vector<int>;

  static const MarchingCubesCases& Get();

  /// The loops of a case. Across joined faces (one bit for each, see CanJoin) the matter hangs together.
  const std::vector<Loop>& Loops(int matterCorners, int joinedFaces = 0) const
  {
    return this->Cases[matterCorners][joinedFaces].loops;
  }

  int NumberOfTriangles(int matterCorners, int joinedFaces = 0) const
  {
    return this->Cases[matterCorners][joinedFaces].triangles;
  }

  /// Whether all these faces are ambiguous and they, or any of them, may be joined without the cube's
  /// triangles meeting, wherever its vertices are. A face must be joined in both of its cubes.
  bool CanJoin(int matterCorners, int faces) const
  {
    return faces < static_cast<int>(this->Cases[matterCorners].size()) &&
      this->Cases[matterCorners][faces].canJoin;
  }

  /// Whether with these faces joined there is one loop, about which no fan keeps off the faces but one
  /// from a vertex inside of the cube.
  bool NeedsMiddle(int matterCorners, int joinedFaces) const
  {
    return this->Cases[matterCorners][joinedFaces].needsMiddle;
  }

  /// The faces that two lines cross, one bit for each.
  static int AmbiguousFaces(int matterCorners);

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
  struct Case
  {
    std::vector<Loop> loops;
    int triangles = 0;
    bool needsMiddle = false;
    bool canJoin = false;
  };
  MarchingCubesCases();
  static Case MakeCase(int matterCorners, int joinedFaces);

  std::array<std::vector<Case>, 256> Cases; ///< by the joined faces
};

}

#endif
