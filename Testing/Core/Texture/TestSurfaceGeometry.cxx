// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/SurfaceGeometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

TEST(SurfaceGeometry, NormalsAreasAndMiddles)
{
  const TriangleMesh mesh = { { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 4, 0 }, { 6, 0, 0 }, { NAN, 0, 0 } },
    { { 0, 1, 2 }, { 2, 1, 0 }, { 0, 1, 3 }, { 0, 1, 4 } } };
  const SurfaceGeometry geometry(mesh);
  EXPECT_EQ(geometry.normals[0], Vector3d(0, 0, 1));
  EXPECT_EQ(geometry.normals[1], Vector3d(0, 0, -1));
  EXPECT_DOUBLE_EQ(geometry.areas[0], 6);
  EXPECT_LT((geometry.Middle(0) - Vector3d(1, 4.0 / 3, 0)).norm(), 1e-12);
  for (const int without : { 2, 3 })
  {
    EXPECT_EQ(geometry.normals[without], Vector3d(0, 0, 0));
    EXPECT_EQ(geometry.areas[without], 0);
  }
}

// A grid of squares with holes: the neighbour across a side is the triangle that has the side the other way round.
TEST(SurfaceGeometry, NeighboursAgreeWithBruteForce)
{
  std::mt19937 random(2);
  constexpr int side = 12;
  TriangleMesh mesh;
  for (int i = 0; i < side * side; ++i)
  {
    mesh.points.emplace_back(i % side, i / side, random() % 3);
  }
  for (int j = 0; j + 1 < side; ++j)
  {
    for (int i = 0; i + 1 < side; ++i)
    {
      const int a = j * side + i, c = a + side;
      if (random() % 5 > 0)
      {
        mesh.triangles.push_back({ a + 1, c + 1, a });
      }
      if (random() % 5 > 0)
      {
        mesh.triangles.push_back({ a, c + 1, c });
      }
    }
  }
  const SurfaceGeometry geometry(mesh);
  int borders = 0, inner = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      int expected = -1;
      for (std::size_t other = 0; other < mesh.triangles.size(); ++other)
      {
        for (int k = 0; k < 3; ++k)
        {
          if (mesh.triangles[other][k] == mesh.triangles[t][(corner + 1) % 3] &&
            mesh.triangles[other][(k + 1) % 3] == mesh.triangles[t][corner])
          {
            expected = static_cast<int>(other);
          }
        }
      }
      EXPECT_EQ(geometry.neighbors[t][corner], expected) << t << " " << corner;
      (expected < 0 ? borders : inner) += 1;
    }
  }
  EXPECT_GT(borders, 50);
  EXPECT_GT(inner, 200);
}
