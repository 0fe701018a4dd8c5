// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/MarchingCubesCases.h"

#include <algorithm>
#include <utility>

namespace freespace
{

namespace
{

using Face = std::array<int, 4>;

// The corners of each face, counter-clockwise from outside of the cube.
std::array<Face, 6> MakeFaces()
{
  std::array<Face, 6> faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, up = 1 << axis;
    faces[2 * axis] = { v, u | v, u, 0 };
    faces[2 * axis + 1] = { up, up | u, up | u | v, up | v };
  }
  return faces;
}

int EdgeBetween(int a, int b)
{
  for (int edge = 0; edge < 12; ++edge)
  {
    const int begin = MarchingCubesCases::Begin(edge), end = begin | 1 << (edge >> 2);
    if ((begin == a && end == b) || (begin == b && end == a))
    {
      return edge;
    }
  }
  return -1;
}

bool ShareFace(const std::array<Face, 6>& faces, int edgeA, int edgeB)
{
  const auto holds = [](const Face& face, int edge)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (EdgeBetween(face[i], face[(i + 1) % 4]) == edge)
      {
        return true;
      }
    }
    return false;
  };
  return std::any_of(faces.begin(), faces.end(),
    [&](const Face& face) { return holds(face, edgeA) && holds(face, edgeB); });
}

// For each crossed edge the one that a loop goes on to: around each face, from where matter is
// entered to where that run of matter is left; around a joined face, to where the run before is left.
std::array<int, 12> Successors(const std::array<Face, 6>& faces, int matter, int joinedFaces)
{
  std::array<int, 12> next;
  next.fill(-1);
  for (int f = 0; f < 6; ++f)
  {
    const Face& face = faces[f];
    const auto isMatter = [&](int i) { return (matter >> face[i % 4] & 1) != 0; };
    for (int i = 0; i < 4; ++i)
    {
      if (!isMatter(i) && isMatter(i + 1))
      {
        int j = (joinedFaces >> f & 1) != 0 ? i + 3 : i + 1;
        while (isMatter(j + 1))
        {
          ++j;
        }
        next[EdgeBetween(face[i], face[(i + 1) % 4])] = EdgeBetween(face[j % 4], face[(j + 1) % 4]);
      }
    }
  }
  return next;
}

// Turns the loop so that its fan keeps off the faces. False: it cannot.
bool BringApexToFront(const std::array<Face, 6>& faces, MarchingCubesCases::Loop& loop)
{
  for (std::size_t turn = 0; turn < loop.size(); ++turn)
  {
    const bool clear = std::none_of(loop.begin() + 2, loop.end() - 1,
      [&](int edge) { return ShareFace(faces, loop.front(), edge); });
    if (clear)
    {
      return true;
    }
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
  return false;
}

// Whether a plane parts the cube's edges that two loops pass; then it parts all that is between the
// edges of each.
bool ArePartedByAPlane(const MarchingCubesCases::Loop& a, const MarchingCubesCases::Loop& b)
{
  const auto range = [](const MarchingCubesCases::Loop& loop, const std::array<int, 3>& normal)
  {
    std::pair<int, int> heights(9, -9);
    for (int edge : loop)
    {
      const int begin = MarchingCubesCases::Begin(edge);
      for (int corner : { begin, begin | 1 << (edge >> 2) })
      {
        int height = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          height += normal[axis] * (corner >> axis & 1);
        }
        heights = { std::min(heights.first, height), std::max(heights.second, height) };
      }
    }
    return heights;
  };
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> normal = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    const auto low = range(a, normal), high = range(b, normal);
    // Within its plane neither may lie: then vertices inside of the edges are off it.
    if (low.second <= high.first && low.first < low.second && high.first < high.second)
    {
      return true;
    }
  }
  return false;
}

}

MarchingCubesCases::MarchingCubesCases()
{
  for (int matter = 0; matter < 256; ++matter)
  {
    const int ambiguous = AmbiguousFaces(matter);
    std::vector<Case>& cases = this->Cases[matter];
    for (int faces = 0; faces <= ambiguous; ++faces)
    {
      const bool areAmbiguous = (faces & ~ambiguous) == 0;
      cases.push_back(areAmbiguous ? MakeCase(matter, faces) : Case());
      // Some of the faces are not joined when the cubes beyond them refuse.
      for (int face = 0; face < 6 && cases.back().canJoin; ++face)
      {
        cases.back().canJoin = (faces >> face & 1) == 0 || cases[faces & ~(1 << face)].canJoin;
      }
    }
  }
}

MarchingCubesCases::Case MarchingCubesCases::MakeCase(int matter, int joinedFaces)
{
  static const std::array<Face, 6> faces = MakeFaces();
  std::array<int, 12> next = Successors(faces, matter, joinedFaces);
  Case made;
  bool haveFans = true, areApart = true;
  for (int edge = 0; edge < 12; ++edge)
  {
    Loop loop;
    for (int at = edge; next[at] >= 0;)
    {
      loop.push_back(at);
      at = std::exchange(next[at], -1);
    }
    if (!loop.empty())
    {
      haveFans = BringApexToFront(faces, loop) && haveFans;
      areApart = areApart &&
        std::all_of(made.loops.begin(), made.loops.end(),
          [&](const Loop& other) { return ArePartedByAPlane(loop, other); });
      made.triangles += static_cast<int>(loop.size()) - 2;
      made.loops.push_back(std::move(loop));
    }
  }
  made.needsMiddle = !haveFans && made.loops.size() == 1;
  made.canJoin = (haveFans && areApart) || made.needsMiddle;
  return made;
}

int MarchingCubesCases::CommonFace(int edgeA, int edgeB)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int a = Begin(edgeA) >> axis & 1, b = Begin(edgeB) >> axis & 1;
    if (edgeA >> 2 != axis && edgeB >> 2 != axis && a == b)
    {
      return 2 * axis + a;
    }
  }
  return -1;
}

bool MarchingCubesCases::IsAmbiguous(int matterCorners, int face)
{
  const int axis = face >> 1, base = (face & 1) << axis;
  const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  const auto matter = [&](int corner) { return matterCorners >> corner & 1; };
  return matter(base) == matter(base | u | v) && matter(base | u) == matter(base | v) &&
    matter(base) != matter(base | u);
}

int MarchingCubesCases::AmbiguousFaces(int matterCorners)
{
  int faces = 0;
  for (int face = 0; face < 6; ++face)
  {
    faces |= IsAmbiguous(matterCorners, face) << face;
  }
  return faces;
}

const MarchingCubesCases& MarchingCubesCases::Get()
{
  static const MarchingCubesCases cases;
  return cases;
}

}
