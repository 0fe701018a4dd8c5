// SPDX-License-Identifier: BSD-3-Clause
// The raster against loops over all triangles of random maps.
#include "ViewFreespace/DisparityRaster.h"

#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

DisparityRaster RasterOf(const DisparityMap& map)
{
  return DisparityRaster(map, NeverCancelled);
}

// How far a pixel is inside of a triangle of the raster, in cells; negative: outside.
double Inside(const RasterMesh& mesh, const RasterMesh::Triangle& triangle, double x, double y)
{
  double inside = HUGE_VAL;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector2d& a = mesh.Corners()[triangle.corner[i]].position;
    const Eigen::Vector2d& b = mesh.Corners()[triangle.corner[(i + 1) % 3]].position;
    const Eigen::Vector2d along = (b - a).normalized();
    inside = std::min(inside, along.x() * (y - a.y()) - along.y() * (x - a.x()));
  }
  return inside;
}

// By how much a point is in front of the map, in disparity times depth: positive is free, negative matter; 0
// where a border decides, closer than rounding. A point beside the map is matter.
double FreeBy(const RasterMesh& mesh, const Vector3d& point)
{
  RasterMesh::Pixel pixel;
  if (!mesh.Project(point, pixel))
  {
    return -1;
  }
  double nearest = -HUGE_VAL;
  for (const RasterMesh::Triangle& triangle : mesh.Triangles())
  {
    const double inside = Inside(mesh, triangle, pixel.x, pixel.y);
    nearest = std::max(nearest, inside);
    if (inside > 1e-9)
    {
      return 1 - pixel.depth * mesh.Disparity(triangle, pixel.x, pixel.y);
    }
  }
  return nearest > -1e-9 ? 0 : -1;
}

Vector3d Sample(const AlignedBox3d& box, std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  return box.min() + Vector3d(unit(random), unit(random), unit(random)).cwiseProduct(box.sizes());
}

// All of a box is free, or all of it matter, as far as samples and its corners tell.
void ExpectContent(
  const RasterMesh& mesh, const AlignedBox3d& box, BoxContent content, std::mt19937& random)
{
  for (int i = 0; i < 28 && content != BoxContent::Mixed; ++i)
  {
    const Vector3d point =
      i < 8 ? Vector3d(box.corner(static_cast<AlignedBox3d::CornerType>(i))) : Sample(box, random);
    const double free = FreeBy(mesh, point);
    EXPECT_FALSE(content == BoxContent::Free ? free < -1e-9 : free > 1e-9)
      << free << " at " << point.transpose();
  }
}

const AlignedBox3d Scene(Vector3d(-1.5, -1.5, -1.5), Vector3d(1.5, 1.5, 1.5)); // of RandomMaps

}

TEST(DisparityRaster, OfNoTrianglesIsEmptyAndClaimsNothing)
{
  const DisparityRaster raster = RasterOf(DisparityMap());
  EXPECT_TRUE(raster.IsEmpty());
  EXPECT_EQ(raster.Classify(Scene), BoxContent::Matter);
  EXPECT_EQ(raster.ClassifyFinely(Scene), BoxContent::Matter);
  EXPECT_FALSE(raster.MayCover(Scene));
}

TEST(DisparityRaster, BuildingCanBeCancelled)
{
  const CancellationFlag stop{ true };
  EXPECT_THROW(DisparityRaster(RandomMaps(1, 1)[0], stop), Aborted);
}

TEST(DisparityRaster, FindsTheTriangleOfEachPixel)
{
  std::mt19937 random(7);
  int found = 0, outside = 0;
  for (const DisparityMap& map : RandomMaps(7, 20))
  {
    const DisparityRaster raster = RasterOf(map);
    const RasterMesh& mesh = raster.Mesh();
    std::uniform_real_distribution<double> x(0, mesh.Width()), y(0, mesh.Height());
    for (int i = 0; i < 500; ++i)
    {
      const RasterMesh::Pixel pixel = { x(random), y(random), 1 };
      const int triangle = raster.Find(pixel);
      double deepest = -HUGE_VAL;
      for (const RasterMesh::Triangle& each : mesh.Triangles())
      {
        deepest = std::max(deepest, Inside(mesh, each, pixel.x, pixel.y));
      }
      if (deepest > 1e-9)
      {
        ASSERT_GE(triangle, 0);
        EXPECT_GE(Inside(mesh, mesh.Triangles()[triangle], pixel.x, pixel.y), -1e-9);
        ++found;
      }
      else if (deepest < -1e-9)
      {
        EXPECT_EQ(triangle, -1);
        ++outside;
      }
    }
  }
  EXPECT_GT(found, 2000);
  EXPECT_GT(outside, 500);
}

TEST(DisparityRaster, CellsListTheTrianglesThatTouchThemAndBoundThem)
{
  std::mt19937 random(11);
  int covered = 0, partly = 0;
  for (const DisparityMap& map : RandomMaps(11, 10))
  {
    const DisparityRaster raster = RasterOf(map);
    const RasterMesh& mesh = raster.Mesh();
    std::uniform_real_distribution<double> unit(0, 1);
    for (int row = 0; row < mesh.Height(); ++row)
    {
      for (int column = 0; column < mesh.Width(); ++column)
      {
        const std::size_t at = raster.CellAt(column, row);
        const DisparityRaster::Cell& cell = raster[at];
        const auto list = raster.TrianglesOf(at);
        EXPECT_EQ(cell.triangle >= 0, list.size() > 0);
        for (int i = 0; i < 8; ++i)
        {
          const double x = column + unit(random), y = row + unit(random);
          bool isCovered = false;
          for (int t = 0; t < static_cast<int>(mesh.Triangles().size()); ++t)
          {
            if (Inside(mesh, mesh.Triangles()[t], x, y) > 1e-9)
            {
              const double disparity = mesh.Disparity(mesh.Triangles()[t], x, y);
              EXPECT_LE(cell.low, disparity);
              EXPECT_GE(cell.high, disparity);
              EXPECT_NE(std::find(list.begin(), list.end(), t), list.end());
              isCovered = true;
            }
          }
          covered += isCovered;
          if (!isCovered && cell.high < Infinity)
          {
            // An upper bound says that all of the cell is covered, but for the sides of triangles.
            double deepest = -HUGE_VAL;
            for (const RasterMesh::Triangle& each : mesh.Triangles())
            {
              deepest = std::max(deepest, Inside(mesh, each, x, y));
            }
            EXPECT_GT(deepest, -1e-9);
          }
          partly += !isCovered;
        }
      }
    }
  }
  EXPECT_GT(covered, 1000);
  EXPECT_GT(partly, 1000);
}

TEST(DisparityRaster, ThePyramidBoundsWhatIsBelow)
{
  for (const DisparityMap& map : RandomMaps(3, 10))
  {
    const DisparityRaster raster = RasterOf(map);
    const auto& levels = raster.Pyramid();
    ASSERT_EQ(levels[0].width, raster.Mesh().Width());
    ASSERT_EQ(levels[0].height, raster.Mesh().Height());
    EXPECT_EQ(levels.back().bounds.size(), 1u);
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
      const int side = 1 << level;
      for (int y = 0; y < levels[level].height; ++y)
      {
        for (int x = 0; x < levels[level].width; ++x)
        {
          float low = Infinity, high = -Infinity;
          for (int row = y * side; row < std::min((y + 1) * side, levels[0].height); ++row)
          {
            for (int column = x * side; column < std::min((x + 1) * side, levels[0].width);
                 ++column)
            {
              low = std::min(low, raster[raster.CellAt(column, row)].low);
              high = std::max(high, raster[raster.CellAt(column, row)].high);
            }
          }
          EXPECT_EQ(levels[level].bounds[y * levels[level].width + x], std::pair(low, high));
        }
      }
    }
  }
}

TEST(DisparityRaster, WhatItSaysOfABoxHoldsAtEachOfItsPoints)
{
  std::mt19937 random(19);
  std::uniform_real_distribution<double> exponent(-9, 0);
  int contents[2][3] = {};
  for (const DisparityMap& map : RandomMaps(19, 30))
  {
    const DisparityRaster raster = RasterOf(map);
    for (int i = 0; i < 200; ++i)
    {
      const Vector3d center = Sample(Scene, random);
      const Vector3d half = std::exp2(exponent(random)) * Vector3d(1, 0.7, 1.3);
      const AlignedBox3d box(center - half, center + half);
      const BoxContent coarse = raster.Classify(box), fine = raster.ClassifyFinely(box);
      ExpectContent(raster.Mesh(), box, coarse, random);
      ExpectContent(raster.Mesh(), box, fine, random);
      ++contents[0][static_cast<int>(coarse)];
      ++contents[1][static_cast<int>(fine)];
      RasterMesh::Pixel pixel;
      EXPECT_TRUE(raster.MayCover(box) || !raster.Mesh().Project(Sample(box, random), pixel));
    }
  }
  for (const auto& counts : contents)
  {
    for (const int count : counts)
    {
      EXPECT_GT(count, 100) << "free, matter and mixed all occur";
    }
  }
}

// As a box shrinks about a point off the surface, it becomes free or matter, whichever the point is.
TEST(DisparityRaster, SmallBoxesAreDecided)
{
  std::mt19937 random(29);
  int decided[2] = {};
  for (const DisparityMap& map : RandomMaps(29, 30))
  {
    const DisparityRaster raster = RasterOf(map);
    for (int i = 0; i < 100; ++i)
    {
      const Vector3d center = Sample(Scene, random);
      RasterMesh::Pixel pixel;
      const double free = FreeBy(raster.Mesh(), center);
      if (!raster.Mesh().Project(center, pixel) || std::abs(free) < 1e-3)
      {
        continue;
      }
      double border = HUGE_VAL; // how close the pixel is to a triangle's side
      for (const RasterMesh::Triangle& each : raster.Mesh().Triangles())
      {
        border = std::min(border, std::abs(Inside(raster.Mesh(), each, pixel.x, pixel.y)));
      }
      if (border > 1e-2)
      {
        const AlignedBox3d box(
          center - Vector3d::Constant(1e-6), center + Vector3d::Constant(1e-6));
        EXPECT_EQ(raster.ClassifyFinely(box), free > 0 ? BoxContent::Free : BoxContent::Matter)
          << free;
        ++decided[free > 0];
      }
    }
  }
  EXPECT_GT(decided[0], 200);
  EXPECT_GT(decided[1], 200);
}
