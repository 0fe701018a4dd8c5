// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/TexturePainter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace freespace
{

TexturePainter::TexturePainter(const SurfaceGeometry& surface, const std::vector<Chart>& packed,
  TextureAtlas& painted, const TextureAtlasOptions& settings)
  : Surface(surface)
  , Charts(packed)
  , Atlas(painted)
  , Options(settings)
  , Owner(std::size_t(painted.width) * painted.height, -1)
  , OwnerChart(this->Owner.size(), -1)
  , Painted(this->Owner.size(), 0)
{
  for (std::size_t i = 0; i < packed.size(); ++i)
  {
    this->Claim(static_cast<int>(i));
  }
}

Eigen::Vector2d TexturePainter::TexelOf(const Chart& chart, const Eigen::Vector3d& point) const
{
  const Eigen::Vector2d inside = (chart.Flat(point) - chart.low) / this->Atlas.texel;
  return inside + Eigen::Vector2d(chart.column, chart.row) +
    Eigen::Vector2d::Constant(this->Options.gutter + 0.5);
}

void TexturePainter::PaintRow(int row, const SurfaceColor& color)
{
  for (int column = 0; column < this->Atlas.width; ++column)
  {
    const std::size_t at = std::size_t(row) * this->Atlas.width + column;
    if (this->Owner[at] >= 0)
    {
      const auto seen =
        color.At(this->PointAt(column, row, at), this->Surface.normals[this->Owner[at]]);
      if (seen)
      {
        this->Set(at, *seen);
      }
    }
  }
}

void TexturePainter::Spread()
{
  std::vector<std::size_t> front;
  for (std::size_t at = 0; at < this->Painted.size(); ++at)
  {
    if (this->Painted[at])
    {
      front.push_back(at);
    }
  }
  for (int step = 0; !front.empty(); ++step)
  {
    std::vector<std::size_t> next;
    for (const std::size_t at : front)
    {
      this->SpreadFrom(at, step < 2 * this->Options.gutter, next);
    }
    for (const std::size_t at : next)
    {
      this->Painted[at] = 1;
    }
    front.swap(next);
  }
}

// Marks the texels whose centres the triangles of a chart cover.
void TexturePainter::Claim(int index)
{
  const Chart& chart = this->Charts[index];
  for (const int triangle : chart.triangles)
  {
    std::array<Eigen::Vector2d, 3> flat;
    for (int i = 0; i < 3; ++i)
    {
      flat[i] = this->TexelOf(chart, this->Surface.Corner(triangle, i));
    }
    ForEachCell(flat,
      [&](int column, int row)
      {
        const std::size_t at = std::size_t(row) * this->Atlas.width + column;
        this->Owner[at] = triangle;
        this->OwnerChart[at] = index;
      });
  }
}

// The point in the plane of the triangle that projects to the centre of the texel.
Eigen::Vector3d TexturePainter::PointAt(int column, int row, std::size_t at) const
{
  const Chart& chart = this->Charts[this->OwnerChart[at]];
  const Eigen::Vector2d flat = chart.low +
    this->Atlas.texel *
      (Eigen::Vector2d(column - chart.column, row - chart.row) -
        Eigen::Vector2d::Constant(this->Options.gutter));
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  point[(chart.axis + 1) % 3] = chart.sign * flat.x();
  point[(chart.axis + 2) % 3] = flat.y();
  const Eigen::Vector3d& normal = this->Surface.normals[this->Owner[at]];
  point[chart.axis] =
    normal.dot(this->Surface.Corner(this->Owner[at], 0) - point) / normal[chart.axis];
  return point;
}

void TexturePainter::SpreadFrom(std::size_t at, bool intoGutter, std::vector<std::size_t>& next)
{
  const int column = static_cast<int>(at % this->Atlas.width);
  const int row = static_cast<int>(at / this->Atlas.width);
  const int steps[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
  for (const auto& step : steps)
  {
    const int u = column + step[0];
    const int v = row + step[1];
    if (u < 0 || v < 1 || u >= this->Atlas.width || v >= this->Atlas.height)
    {
      continue;
    }
    const std::size_t to = std::size_t(v) * this->Atlas.width + u;
    const bool gutter = this->Owner[to] < 0;
    if (this->Painted[to] == 0 && (!gutter || intoGutter))
    {
      std::copy_n(&this->Atlas.rgb[3 * at], 3, &this->Atlas.rgb[3 * to]);
      this->Painted[to] = 2; // taken; it spreads in the next round
      next.push_back(to);
    }
  }
}

void TexturePainter::Set(std::size_t at, const Eigen::Vector3d& color)
{
  for (int channel = 0; channel < 3; ++channel)
  {
    this->Atlas.rgb[3 * at + channel] = static_cast<unsigned char>(std::lround(color[channel]));
  }
  this->Painted[at] = 1;
}

}
