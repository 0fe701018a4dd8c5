// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/TexturePainter.h"

#include "Support/Core/SmallImage.h"
#include "Texture/ChartPacking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

const std::array<int, 3> UnseenColor = { 1, 2, 3 }; // that no pixel has

// An image whose colours are linear in the pixel, so that they are exact between pixels.
Photograph GradientPhotograph()
{
  Photograph photograph;
  photograph.camera = SmallCamera();
  for (int row = 0; row < photograph.camera.height; ++row)
  {
    for (int column = 0; column < photograph.camera.width; ++column)
    {
      const int color[3] = { 60 + 4 * column, 60 + 5 * row, 230 - 2 * column - 3 * row };
      photograph.rgb.insert(photograph.rgb.end(), color, color + 3);
    }
  }
  return photograph;
}

// Triangles in all directions before the camera, of which it sees some.
TriangleMesh RandomTriangles(unsigned int seed, int count)
{
  const Camera camera = SmallCamera();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> column(-5, 45), row(-5, 35), depth(3, 6), side(-0.6, 0.6);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const Vector3d middle = camera.Unproject({ column(random), row(random) }, depth(random));
    const auto corner = [&]
    { return Vector3d(middle + Vector3d(side(random), side(random), side(random))); };
    const Vector3d a = corner(), b = corner(), c = corner();
    AddTriangle(mesh, a, b, c);
  }
  return mesh;
}

// An atlas with a chart for each triangle.
struct PaintedAtlas
{
  PaintedAtlas(const TriangleMesh& mesh, double texel, int gutter)
    : geometry(mesh)
  {
    this->options.gutter = gutter;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      Chart chart;
      this->geometry.normals[t].cwiseAbs().maxCoeff(&chart.axis);
      chart.sign = std::copysign(1.0, this->geometry.normals[t][chart.axis]);
      chart.triangles = { static_cast<int>(t) };
      for (int i = 0; i < 3; ++i)
      {
        const Vector2d flat = chart.Flat(this->geometry.Corner(static_cast<int>(t), i));
        chart.low = chart.low.cwiseMin(flat);
        chart.high = chart.high.cwiseMax(flat);
      }
      this->charts.push_back(chart);
    }
    EXPECT_TRUE(PackCharts(this->charts, texel, this->options, this->atlas));
    this->atlas.texel = texel;
    this->atlas.width = this->atlas.height = 1; // without room that no chart needs
    for (const Chart& chart : this->charts)
    {
      this->atlas.width = std::max(this->atlas.width, chart.column + chart.width);
      this->atlas.height = std::max(this->atlas.height, chart.row + chart.height);
    }
    for (int i = 0; i < this->atlas.width * this->atlas.height; ++i)
    {
      this->atlas.rgb.insert(this->atlas.rgb.end(), UnseenColor.begin(), UnseenColor.end());
    }
  }

  void PaintRows(TexturePainter& painter, const SurfaceColor& color) const
  {
    for (int row = 0; row < this->atlas.height; ++row)
    {
      painter.PaintRow(row, color);
    }
  }

  std::array<int, 3> At(int column, int row) const
  {
    const unsigned char* rgb = &this->atlas.rgb[3 * (row * this->atlas.width + column)];
    return { rgb[0], rgb[1], rgb[2] };
  }

  SurfaceGeometry geometry;
  std::vector<Chart> charts;
  TextureAtlas atlas;
  TextureAtlasOptions options;
};

// The weights of a triangle's corners at a place in its plane.
Vector3d WeightsAt(const Vector2d& place, const std::array<Vector2d, 3>& corners)
{
  Eigen::Matrix3d system;
  system << corners[0].homogeneous(), corners[1].homogeneous(), corners[2].homogeneous();
  return system.inverse() * place.homogeneous();
}

// The triangle of the texel's centre, and the point there; -1 for none.
int TriangleAt(
  const PaintedAtlas& painted, const TexturePainter& painter, int column, int row, Vector3d& point)
{
  for (std::size_t t = 0; t < painted.charts.size(); ++t)
  {
    const int triangle = static_cast<int>(t);
    std::array<Vector2d, 3> corners;
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = painter.TexelOf(painted.charts[t], painted.geometry.Corner(triangle, i));
    }
    const Vector3d weights = WeightsAt({ column + 0.5, row + 0.5 }, corners);
    // A corner may be at a texel's centre.
    if (weights.minCoeff() >= -1e-12)
    {
      point = weights[0] * painted.geometry.Corner(triangle, 0) +
        weights[1] * painted.geometry.Corner(triangle, 1) +
        weights[2] * painted.geometry.Corner(triangle, 2);
      return triangle;
    }
  }
  return -1;
}

}

TEST(TexturePainter, AChartsCornerIsInsideOfItsGutter)
{
  const TriangleMesh mesh;
  const SurfaceGeometry geometry(mesh);
  TextureAtlas atlas;
  atlas.texel = 0.25;
  TextureAtlasOptions options;
  options.gutter = 3;
  Chart chart;
  chart.axis = 1; // flat: z and x
  chart.low = { 2, -1 };
  chart.column = 10;
  chart.row = 20;
  const std::vector<Chart> charts;
  const TexturePainter painter(geometry, charts, atlas, options);
  EXPECT_EQ(painter.TexelOf(chart, { -1, 77, 2 }), Vector2d(13.5, 23.5));
  EXPECT_EQ(painter.TexelOf(chart, { 0, 77, 4 }), Vector2d(21.5, 27.5));
  chart.sign = -1; // mirrored
  EXPECT_EQ(painter.TexelOf(chart, { 0, 77, -4 }), Vector2d(21.5, 27.5));
}

TEST(TexturePainter, TexelsHaveTheColoursOfTheirPoints)
{
  int seen = 0, unseen = 0;
  for (unsigned int seed = 1; seed < 5; ++seed)
  {
    const TriangleMesh mesh = RandomTriangles(seed, 30);
    const SurfaceColor color(mesh, { GradientPhotograph() });
    PaintedAtlas painted(mesh, 0.04, 2);
    TexturePainter painter(painted.geometry, painted.charts, painted.atlas, painted.options);
    painted.PaintRows(painter, color);
    for (int row = 0; row < painted.atlas.height; ++row)
    {
      for (int column = 0; column < painted.atlas.width; ++column)
      {
        Vector3d point;
        const int triangle = TriangleAt(painted, painter, column, row, point);
        const auto expected =
          triangle < 0 ? std::nullopt : color.At(point, painted.geometry.normals[triangle]);
        const std::array<int, 3> found = painted.At(column, row);
        for (int channel = 0; channel < 3; ++channel)
        {
          const double wanted = expected ? (*expected)[channel] : UnseenColor[channel];
          EXPECT_NEAR(found[channel], wanted, 0.5 + 1e-6) << column << " " << row;
        }
        (expected ? seen : unseen) += triangle >= 0;
      }
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(unseen, 1000);
}

// Each step takes a neighbour's colour: through charts without end, elsewhere twice the gutter far, and never into the
// first row.
TEST(TexturePainter, ColoursSpreadStepByStep)
{
  for (unsigned int seed = 1; seed < 25; ++seed)
  {
    const TriangleMesh mesh = RandomTriangles(seed, 20);
    const SurfaceColor color(mesh, { GradientPhotograph() });
    const int gutter = static_cast<int>(seed % 3);
    PaintedAtlas painted(mesh, 0.05, gutter);
    TexturePainter painter(painted.geometry, painted.charts, painted.atlas, painted.options);
    painted.PaintRows(painter, color);
    const int width = painted.atlas.width, height = painted.atlas.height;
    constexpr int never = 1 << 20;
    std::vector<int> steps(width * height, never);
    std::vector<char> isGutter(steps.size());
    for (int at = 0; at < width * height; ++at)
    {
      Vector3d point;
      isGutter[at] = TriangleAt(painted, painter, at % width, at / width, point) < 0;
      steps[at] = painted.At(at % width, at / width) == UnseenColor ? never : 0;
    }
    const auto neighbors = [&](int at)
    {
      std::vector<int> all;
      for (const int to : { at % width > 0 ? at - 1 : -1, at % width + 1 < width ? at + 1 : -1,
             at - width, at + width < width * height ? at + width : -1 })
      {
        if (to >= 0)
        {
          all.push_back(to);
        }
      }
      return all;
    };
    for (bool changes = true; changes;)
    {
      changes = false;
      for (int at = width; at < width * height; ++at)
      {
        for (const int from : neighbors(at))
        {
          const int step = steps[from] + 1;
          if (step < steps[at] && (!isGutter[at] || step <= 2 * gutter))
          {
            steps[at] = step;
            changes = true;
          }
        }
      }
    }
    const auto before = painted.atlas.rgb;
    painter.Spread();
    int reached = 0;
    for (int at = 0; at < width * height; ++at)
    {
      const std::array<int, 3> found = painted.At(at % width, at / width);
      if (steps[at] == 0 || steps[at] == never)
      {
        EXPECT_TRUE(std::equal(found.begin(), found.end(), &before[3 * at])) << at;
        continue;
      }
      ++reached;
      const std::vector<int> around = neighbors(at);
      EXPECT_TRUE(std::any_of(around.begin(), around.end(),
        [&](int from) {
          return steps[from] == steps[at] - 1 && found == painted.At(from % width, from / width);
        }))
        << at;
    }
    EXPECT_GT(reached, gutter > 0 ? 100 : 0);
  }
}

TEST(TexturePainter, NothingSeenAndNothingThere)
{
  const TriangleMesh mesh = RandomTriangles(3, 5), none;
  const SurfaceColor blind(mesh, {});
  for (const TriangleMesh* some : { &mesh, &none })
  {
    PaintedAtlas painted(*some, 0.05, 2);
    const auto before = painted.atlas.rgb;
    TexturePainter painter(painted.geometry, painted.charts, painted.atlas, painted.options);
    painted.PaintRows(painter, blind);
    painter.Spread();
    EXPECT_EQ(painted.atlas.rgb, before);
  }
}
