// SPDX-License-Identifier: BSD-3-Clause
#include "CubeCases.h"

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

std::vector<Triangle> Triangles(int matter, int joinedFace = CubeCases::NoFace)
{
  std::vector<Triangle> triangles;
  for (const CubeCases::Loop& loop : CubeCases::Get().Loops(matter, joinedFace))
  {
    for (std::size_t i = 2; i < loop.size(); ++i)
    {
      triangles.push_back({ loop[0], loop[i - 1], loop[i] });
    }
  }
  return triangles;
}

bool OnOneFace(int edgeA, int edgeB)
{
  const int corners[4] = { CubeCases::Begin(edgeA), CubeCases::Begin(edgeA) | 1 << (edgeA >> 2),
    CubeCases::Begin(edgeB), CubeCases::Begin(edgeB) | 1 << (edgeB >> 2) };
  int ones = 7, zeros = 7;
  for (int c : corners)
  {
    ones &= c;
    zeros &= ~c;
  }
  return (ones | zeros) != 0;
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
bool Meet(const Triangle& a, const Triangle& b, const std::array<Vector3d, 12>& at)
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

TEST(CubeCases, LoopsHoldEachCrossedEdgeOnce)
{
  for (int matter = 0; matter < 256; ++matter)
  {
    std::multiset<int> crossed, inLoops;
    for (int edge = 0; edge < 12; ++edge)
    {
      const int begin = CubeCases::Begin(edge), end = begin | 1 << (edge >> 2);
      EXPECT_NE(begin, end);
      if ((matter >> begin & 1) != (matter >> end & 1))
      {
        crossed.insert(edge);
      }
    }
    for (const CubeCases::Loop& loop : CubeCases::Get().Loops(matter))
    {
      inLoops.insert(loop.begin(), loop.end());
      EXPECT_GE(loop.size(), 3u);
    }
    EXPECT_EQ(crossed, inLoops) << "case " << matter;
  }
}

TEST(CubeCases, JoinedFacesHangTogether)
{
  int joinable = 0;
  for (int matter = 0; matter < 256; ++matter)
  {
    for (int face = 0; face < 6; ++face)
    {
      if (!CubeCases::Get().CanJoin(matter, face))
      {
        continue;
      }
      ++joinable;
      EXPECT_TRUE(CubeCases::IsAmbiguous(matter, face));
      // The same crossings, but the lines over the face cut off its free corners.
      std::multiset<int> parted, joined;
      std::map<int, int> next;
      for (const CubeCases::Loop& loop : CubeCases::Get().Loops(matter))
      {
        parted.insert(loop.begin(), loop.end());
      }
      for (const CubeCases::Loop& loop : CubeCases::Get().Loops(matter, face))
      {
        joined.insert(loop.begin(), loop.end());
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
          next[loop[i]] = loop[(i + 1) % loop.size()];
        }
      }
      EXPECT_EQ(parted, joined);
      int cutOff = 0;
      for (const auto& [a, b] : next)
      {
        if (CubeCases::CommonFace(a, b) == face)
        {
          const int ends[2] = { CubeCases::Begin(a), CubeCases::Begin(a) | 1 << (a >> 2) };
          const int others[2] = { CubeCases::Begin(b), CubeCases::Begin(b) | 1 << (b >> 2) };
          const int corner = ends[0] == others[0] || ends[0] == others[1] ? ends[0] : ends[1];
          EXPECT_TRUE(corner == others[0] || corner == others[1]);
          EXPECT_EQ(matter >> corner & 1, 0);
          ++cutOff;
        }
      }
      EXPECT_EQ(cutOff, 2) << "case " << matter << " face " << face;
    }
  }
  EXPECT_GE(joinable, 100);
}

TEST(CubeCases, NoDiagonalLiesOnAFace)
{
  for (int n = 0; n < 7 * 256; ++n)
  {
    const int matter = n / 7;
    for (const CubeCases::Loop& loop : CubeCases::Get().Loops(matter, n % 7 - 1))
    {
      for (std::size_t i = 2; i + 1 < loop.size(); ++i)
      {
        EXPECT_FALSE(OnOneFace(loop[0], loop[i])) << "case " << matter;
      }
    }
  }
}

TEST(CubeCases, NormalsPointOutOfTheMatter)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::vector<Triangle> triangles = Triangles(1 << corner);
    ASSERT_EQ(triangles.size(), 1u);
    Vector3d p[3];
    for (int i = 0; i < 3; ++i)
    {
      const int begin = CubeCases::Begin(triangles[0][i]);
      p[i] = 0.5 * (Corner(begin) + Corner(begin | 1 << (triangles[0][i] >> 2)));
    }
    EXPECT_GT((p[1] - p[0]).cross(p[2] - p[0]).dot(p[0] - Corner(corner)), 0) << corner;
  }
}

TEST(CubeCases, TrianglesNeverMeetWhereverTheVerticesAre)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::array<Vector3d, 12> at;
    for (int edge = 0; edge < 12; ++edge)
    {
      const int begin = CubeCases::Begin(edge), end = begin | 1 << (edge >> 2);
      // Every other trial the vertices crowd at the corners.
      const double s = uniform(random);
      const double place = trial % 2 ? s : s < 0.5 ? 0.01 + 1e-4 * s : 0.99 - 1e-4 * s;
      at[edge] = (1 - place) * Corner(begin) + place * Corner(end);
    }
    for (int n = 0; n < 7 * 256; ++n)
    {
      const int matter = n / 7, joinedFace = n % 7 - 1;
      const std::vector<Triangle> triangles = Triangles(matter, joinedFace);
      for (const Triangle& a : triangles)
      {
        for (const Triangle& b : triangles)
        {
          ASSERT_FALSE(&a != &b && Meet(a, b, at)) << "case " << matter << " face " << joinedFace;
        }
      }
    }
  }
}
