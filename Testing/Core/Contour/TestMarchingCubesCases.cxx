// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/MarchingCubesCases.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

using namespace freespace;
using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

namespace
{

Vector3d Corner(int c)
{
  return Vector3d(c & 1, c >> 1 & 1, c >> 2 & 1);
}

// Beside the vertices on the twelve edges, one inside of the cube.
constexpr int Middle = 12;

std::vector<Triangle> Triangles(int matter, int joinedFaces = 0)
{
  std::vector<Triangle> triangles;
  const bool needsMiddle = MarchingCubesCases::Get().NeedsMiddle(matter, joinedFaces);
  for (const MarchingCubesCases::Loop& loop : MarchingCubesCases::Get().Loops(matter, joinedFaces))
  {
    for (std::size_t i = needsMiddle ? 0 : 2; i < loop.size(); ++i)
    {
      triangles.push_back(
        { needsMiddle ? Middle : loop[0], loop[(i + loop.size() - 1) % loop.size()], loop[i] });
    }
  }
  return triangles;
}

// Calls visit(matter, joined faces) for all cases, without and with each set of faces that can be
// joined.
template <typename Visit>
void ForEachCase(Visit&& visit)
{
  for (int matter = 0; matter < 256; ++matter)
  {
    for (int faces = 0; faces < 64; ++faces)
    {
      if (faces == 0 || MarchingCubesCases::Get().CanJoin(matter, faces))
      {
        visit(matter, faces);
      }
    }
  }
}

bool OnOneFace(int edgeA, int edgeB)
{
  const int corners[4] = { MarchingCubesCases::Begin(edgeA),
    MarchingCubesCases::Begin(edgeA) | 1 << (edgeA >> 2), MarchingCubesCases::Begin(edgeB),
    MarchingCubesCases::Begin(edgeB) | 1 << (edgeB >> 2) };
  int ones = 7, zeros = 7;
  for (int c : corners)
  {
    ones &= c;
    zeros &= ~c;
  }
  return (ones | zeros) != 0;
}

bool IsSideOfALoop(int a, int b, int matter, int joinedFaces)
{
  for (const MarchingCubesCases::Loop& loop : MarchingCubesCases::Get().Loops(matter, joinedFaces))
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const int from = loop[i], to = loop[(i + 1) % loop.size()];
      if ((from == a && to == b) || (from == b && to == a))
      {
        return true;
      }
    }
  }
  return false;
}

bool Crosses(const Vector3d& p, const Vector3d& q, const std::array<Vector3d, 3>& t)
{
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double a = normal.dot(p - t[0]), b = normal.dot(q - t[0]);
  if (a * b >= 0)
  {
    return false;
  }
  const Vector3d x = p + (q - p) * (a / (a - b));
  for (int i = 0; i < 3; ++i)
  {
    if ((t[(i + 1) % 3] - t[i]).cross(x - t[i]).dot(normal) <= 1e-14)
    {
      return false;
    }
  }
  return true;
}

// An edge of one triangle through the inside of another, shared corners aside.
bool Meet(const Triangle& a, const Triangle& b, const std::array<Vector3d, 13>& at)
{
  for (int i = 0; i < 3; ++i)
  {
    const int u = a[i], v = a[(i + 1) % 3];
    const bool shared = std::count(b.begin(), b.end(), u) || std::count(b.begin(), b.end(), v);
    if (!shared && Crosses(at[u], at[v], { at[b[0]], at[b[1]], at[b[2]] }))
    {
      return true;
    }
  }
  return false;
}

}

TEST(MarchingCubesCases, LoopsHoldEachCrossedEdgeOnce)
{
  for (int matter = 0; matter < 256; ++matter)
  {
    std::multiset<int> crossed, inLoops;
    for (int edge = 0; edge < 12; ++edge)
    {
      const int begin = MarchingCubesCases::Begin(edge), end = begin | 1 << (edge >> 2);
      EXPECT_NE(begin, end);
      if ((matter >> begin & 1) != (matter >> end & 1))
      {
        crossed.insert(edge);
      }
    }
    for (const MarchingCubesCases::Loop& loop : MarchingCubesCases::Get().Loops(matter))
    {
      inLoops.insert(loop.begin(), loop.end());
      EXPECT_GE(loop.size(), 3u);
    }
    EXPECT_EQ(crossed, inLoops) << "case " << matter;
  }
}

TEST(MarchingCubesCases, JoinedFacesHangTogether)
{
  std::map<int, int> joinable; // by the number of faces
  ForEachCase(
    [&](int matter, int faces)
    {
      ++joinable[__builtin_popcount(faces)];
      EXPECT_EQ(faces & ~MarchingCubesCases::AmbiguousFaces(matter), 0);
      // The same crossings, but the lines over the faces cut off their free corners.
      std::multiset<int> parted, joined;
      std::map<int, int> next;
      for (const MarchingCubesCases::Loop& loop : MarchingCubesCases::Get().Loops(matter))
      {
        parted.insert(loop.begin(), loop.end());
      }
      for (const MarchingCubesCases::Loop& loop : MarchingCubesCases::Get().Loops(matter, faces))
      {
        joined.insert(loop.begin(), loop.end());
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
          next[loop[i]] = loop[(i + 1) % loop.size()];
        }
      }
      EXPECT_EQ(parted, joined);
      std::map<int, int> freeCutOff, matterCutOff;
      for (const auto& [a, b] : next)
      {
        const int face = MarchingCubesCases::CommonFace(a, b);
        ASSERT_GE(face, 0);
        const int ends[2] = { MarchingCubesCases::Begin(a),
          MarchingCubesCases::Begin(a) | 1 << (a >> 2) };
        const int others[2] = { MarchingCubesCases::Begin(b),
          MarchingCubesCases::Begin(b) | 1 << (b >> 2) };
        for (int corner : ends)
        {
          if (corner == others[0] || corner == others[1])
          {
            ++(matter >> corner & 1 ? matterCutOff : freeCutOff)[face];
          }
        }
      }
      for (int face = 0; face < 6; ++face)
      {
        if (MarchingCubesCases::IsAmbiguous(matter, face))
        {
          const bool isJoined = (faces >> face & 1) != 0;
          EXPECT_EQ(freeCutOff[face], isJoined ? 2 : 0) << "case " << matter << " face " << face;
          EXPECT_EQ(matterCutOff[face], isJoined ? 0 : 2) << "case " << matter << " face " << face;
        }
      }
    });
  EXPECT_GE(joinable[1], 150);
  EXPECT_GE(joinable[2], 50);
  EXPECT_GE(joinable[3], 8);
}

// A face stays parted where the cube beyond it refuses to join it.
TEST(MarchingCubesCases, SomeOfTheFacesThatCanBeJoinedCanBeToo)
{
  ForEachCase(
    [](int matter, int faces)
    {
      for (int some = faces; some > 0; some = (some - 1) & faces)
      {
        EXPECT_TRUE(MarchingCubesCases::Get().CanJoin(matter, some)) << matter << " " << some;
      }
    });
}

// The tip of a block pokes out between its three neighbours' corners: it hangs together over all three
// faces.
TEST(MarchingCubesCases, ATipIsJoinedOverThreeFaces)
{
  const int matter = 1 << 0 | 1 << 1 | 1 << 2 | 1 << 4 | 1 << 7, faces = 1 << 1 | 1 << 3 | 1 << 5;
  EXPECT_EQ(MarchingCubesCases::AmbiguousFaces(matter), faces);
  ASSERT_TRUE(MarchingCubesCases::Get().CanJoin(matter, faces));
  EXPECT_EQ(MarchingCubesCases::Get().Loops(matter, faces).size(), 3u);
  EXPECT_TRUE(MarchingCubesCases::Get().NeedsMiddle(matter, 1 << 5));
  EXPECT_EQ(MarchingCubesCases::Get().Loops(matter, 1 << 5).size(), 1u);
}

TEST(MarchingCubesCases, NoDiagonalLiesOnAFace)
{
  ForEachCase(
    [](int matter, int faces)
    {
      for (const Triangle& triangle : Triangles(matter, faces))
      {
        for (int i = 0; i < 3 && triangle[0] != Middle; ++i)
        {
          const int a = triangle[i], b = triangle[(i + 1) % 3];
          const bool isSide = IsSideOfALoop(a, b, matter, faces);
          EXPECT_TRUE(isSide || !OnOneFace(a, b)) << "case " << matter << " faces " << faces;
        }
      }
    });
}

TEST(MarchingCubesCases, NormalsPointOutOfTheMatter)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::vector<Triangle> triangles = Triangles(1 << corner);
    ASSERT_EQ(triangles.size(), 1u);
    Vector3d p[3];
    for (int i = 0; i < 3; ++i)
    {
      const int begin = MarchingCubesCases::Begin(triangles[0][i]);
      p[i] = 0.5 * (Corner(begin) + Corner(begin | 1 << (triangles[0][i] >> 2)));
    }
    EXPECT_GT((p[1] - p[0]).cross(p[2] - p[0]).dot(p[0] - Corner(corner)), 0) << corner;
  }
}

TEST(MarchingCubesCases, TrianglesNeverMeetWhereverTheVerticesAre)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::array<Vector3d, 13> at;
    at[Middle] = Vector3d(uniform(random), uniform(random), uniform(random));
    for (int edge = 0; edge < 12; ++edge)
    {
      const int begin = MarchingCubesCases::Begin(edge), end = begin | 1 << (edge >> 2);
      // Every other trial the vertices crowd at the corners.
      const double s = uniform(random);
      const double place = trial % 2 ? s : s < 0.5 ? 0.01 + 1e-4 * s : 0.99 - 1e-4 * s;
      at[edge] = (1 - place) * Corner(begin) + place * Corner(end);
    }
    ForEachCase(
      [&](int matter, int faces)
      {
        const std::vector<Triangle> triangles = Triangles(matter, faces);
        for (const Triangle& a : triangles)
        {
          for (const Triangle& b : triangles)
          {
            ASSERT_FALSE(&a != &b && Meet(a, b, at)) << "case " << matter << " faces " << faces;
          }
        }
      });
  }
}
