// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/TextureAtlas.h"

#include "Common/Error.h"
#include "Texture/Chart.h"
#include "Texture/ChartCutter.h"
#include "Texture/ChartPacking.h"
#include "Texture/SurfaceGeometry.h"
#include "Texture/TexturePainter.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <unordered_map>

namespace freespace
{

namespace
{

// The triangles that an image sees at a corner or in the middle, and several rings of triangles around
// them.
std::vector<char> SeenTriangles(
  const SurfaceGeometry& geometry, const SurfaceColor& color, const ParallelFor& parallelFor)
{
  const int rings = 8;
  const std::size_t count = geometry.areas.size();
  std::vector<char> seen(count, 0);
  parallelFor(count,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const int triangle = static_cast<int>(t);
        const Eigen::Vector3d middle = geometry.Middle(triangle);
        // Many samples of a large triangle, the centre alone of one smaller than a pixel.
        const double size = color.PixelSize(middle, geometry.normals[t]);
        seen[t] = std::isfinite(size);
        const bool large = !(geometry.areas[t] < 16 * size * size);
        for (int i = 0; i < 45 && large && !seen[t]; ++i)
        {
          const double s = (i % 9 + 0.5) / 9;
          const double u = (i / 9 + 0.5) / 5 * (1 - s);
          const Eigen::Vector3d point = s * geometry.Corner(triangle, 0) +
            u * geometry.Corner(triangle, 1) + (1 - s - u) * geometry.Corner(triangle, 2);
          seen[t] = color.At(point, geometry.normals[t]).has_value();
        }
      }
    });
  for (int ring = 0; ring < rings; ++ring)
  {
    const std::vector<char> before = seen;
    for (std::size_t t = 0; t < count; ++t)
    {
      for (const int neighbor : geometry.neighbors[t])
      {
        seen[t] = seen[t] || (neighbor >= 0 && before[neighbor]);
      }
    }
  }
  return seen;
}

// The area-weighted median of the size that a pixel of the images has on the surface.
double TexelOfPhotographs(const SurfaceGeometry& geometry, const SurfaceColor& color)
{
  std::vector<std::pair<double, double>> sizes;
  double sum = 0;
  const std::size_t step = std::max<std::size_t>(1, geometry.areas.size() / 5000);
  for (std::size_t t = 0; t < geometry.areas.size(); t += step)
  {
    const double size = color.PixelSize(geometry.Middle(static_cast<int>(t)), geometry.normals[t]);
    if (std::isfinite(size))
    {
      sizes.emplace_back(size, geometry.areas[t]);
      sum += geometry.areas[t];
    }
  }
  std::sort(sizes.begin(), sizes.end());
  double reached = 0;
  for (const auto& [size, area] : sizes)
  {
    reached += area;
    if (2 * reached >= sum)
    {
      return size;
    }
  }
  return 0;
}

// The colour of a texel in the atlas and in the output, its triangle and chart, and whether it is painted.
constexpr double BytesOfTexel = 3 + 3 + 2 * sizeof(int) + 1;
constexpr double Mebibyte = 1 << 20;

// The longest side of an atlas that the memory allows, too.
int LargestSide(const TextureAtlasOptions& options)
{
  constexpr double least = 16;
  const double texels = options.memory * Mebibyte / BytesOfTexel;
  return options.memory > 0
    ? static_cast<int>(std::clamp<double>(std::sqrt(texels), least, options.largest))
    : options.largest;
}

// Charts do not fill the atlas. Throws Error when the texel asked for cannot fit; BakeTexture may still
// make it a little larger.
void CheckTexel(const TextureAtlasOptions& options, double seenArea)
{
  constexpr double filled = 0.7; // of the atlas, about
  const double side = std::sqrt(seenArea / filled);
  if (options.texel > 0 && std::sqrt(seenArea) / options.texel > options.largest)
  {
    std::ostringstream fault;
    fault << std::setprecision(3) << "Texels of side " << options.texel
          << " make a texture of about " << side / options.texel << " x " << side / options.texel
          << ", and its longest side may be " << options.largest << ": texels of side "
          << side / options.largest << " fit.";
    throw Error(fault.str());
  }
  if (options.texel > 0 && std::sqrt(seenArea) / options.texel > LargestSide(options))
  {
    const double texels = side / options.texel * (side / options.texel);
    std::ostringstream fault;
    fault << std::setprecision(3) << "Texels of side " << options.texel
          << " make a texture that takes about " << texels * BytesOfTexel / Mebibyte
          << " MiB, and there are " << options.memory << " MiB for it: texels of side "
          << side / LargestSide(options) << " fit.";
    throw Error(fault.str());
  }
}

// Adds the points of the atlas: one for each chart and each point of the mesh in it.
void AddCoordinates(const SurfaceGeometry& geometry, const std::vector<Chart>& charts,
  const TexturePainter& painter, TextureAtlas& atlas)
{
  const Eigen::Vector2d size(atlas.width, atlas.height);
  std::unordered_map<int, int> indices;
  const auto index = [&](int point, const Eigen::Vector2d& texel)
  {
    const auto [at, fresh] = indices.emplace(point, static_cast<int>(atlas.source.size()));
    if (fresh)
    {
      atlas.source.push_back(point);
      atlas.coordinates.push_back(texel.cwiseQuotient(size));
    }
    return at->second;
  };
  atlas.triangles.assign(geometry.mesh.triangles.size(), { -1, -1, -1 });
  for (const Chart& chart : charts)
  {
    indices.clear();
    for (const int triangle : chart.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        const int point = geometry.mesh.triangles[triangle][i];
        atlas.triangles[triangle][i] =
          index(point, painter.TexelOf(chart, geometry.mesh.points[point]));
      }
    }
  }
  indices.clear();
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
  {
    for (int i = 0; i < 3 && atlas.triangles[t][2] < 0; ++i)
    {
      atlas.triangles[t][i] = index(geometry.mesh.triangles[t][i], { 0.5, 0.5 });
    }
  }
}

}

void TextureAtlasOptions::Check() const
{
  if (!(this->memory >= 0))
  {
    throw Error("The memory for a texture must not be negative.");
  }
  if (!(this->texel >= 0) || this->largest < 16 || this->gutter < 0 || this->gutter > 64)
  {
    throw Error(
      "A texture's texels must not be negative, its largest side at least 16 and its gutter "
      "from 0 to 64.");
  }
}

TextureAtlas BakeTexture(const TriangleMesh& mesh, const SurfaceColor& color,
  const TextureAtlasOptions& wanted, const ParallelFor& parallelFor, const Progress& progress)
{
  wanted.Check();
  TextureAtlas atlas;
  const SurfaceGeometry geometry(mesh);
  const std::vector<char> seen = SeenTriangles(geometry, color, parallelFor);
  progress(0.1);
  atlas.texel = wanted.texel > 0 ? wanted.texel : TexelOfPhotographs(geometry, color);
  double seenArea = 0;
  for (std::size_t t = 0; t < seen.size(); ++t)
  {
    seenArea += seen[t] ? geometry.areas[t] : 0;
  }
  CheckTexel(wanted, seenArea);
  TextureAtlasOptions options = wanted;
  options.largest = LargestSide(wanted);
  // A smaller texel can never fit and would only cost time; 1 if nothing is seen.
  const double smallest = std::sqrt(seenArea) / options.largest;
  atlas.texel = std::max(atlas.texel, smallest > 0 ? smallest : 1.0 * (atlas.texel == 0));
  std::vector<Chart> charts = ChartCutter(geometry, seen, atlas.texel).Cut();
  progress(0.3);
  CheckChartsFit(charts, options, atlas);
  while (!PackCharts(charts, atlas.texel, options, atlas))
  {
    atlas.texel *= 1.1;
  }
  atlas.charts = static_cast<int>(charts.size());
  atlas.rgb.resize(std::size_t(3) * atlas.width * atlas.height);
  for (std::size_t i = 0; i < atlas.rgb.size(); ++i)
  {
    atlas.rgb[i] = static_cast<unsigned char>(options.unseen[i % 3]);
  }
  TexturePainter painter(geometry, charts, atlas, options);
  const int band = 64; // rows between two reports of progress
  for (int first = 0; first < atlas.height; first += band)
  {
    parallelFor(std::min(band, atlas.height - first),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t row = begin; row < end; ++row)
        {
          painter.PaintRow(first + static_cast<int>(row), color);
        }
      });
    progress(0.3 + 0.6 * std::min(atlas.height, first + band) / atlas.height);
  }
  painter.Spread();
  AddCoordinates(geometry, charts, painter, atlas);
  progress(1.0);
  return atlas;
}

}
