// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/TextureAtlas.h"

#include "Common/Error.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <queue>
#include <sstream>
#include <unordered_map>

namespace freespace
{

namespace
{

constexpr double LeastCosine = 0.4; // between a chart's direction and its triangles' normals

/// Triangles seen along one axis, and where the chart's corner is in the atlas.
struct Chart
{
  int axis = 0;    // along which it is seen
  double sign = 1; // from which side
  std::vector<int> triangles;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;

  // The two coordinates across the axis; mirrored on the one side so that charts are not.
  Eigen::Vector2d Flat(const Eigen::Vector3d& point) const
  {
    return { this->sign * point[(this->axis + 1) % 3], point[(this->axis + 2) % 3] };
  }
};

struct Geometry
{
  const TriangleMesh& mesh;
  std::vector<Eigen::Vector3d> normals; // unit; zero without area
  std::vector<double> areas;
  std::vector<std::array<int, 3>> neighbors; // across the side after each corner, or -1

  explicit Geometry(const TriangleMesh& given)
    : mesh(given)
    , normals(given.triangles.size())
    , areas(given.triangles.size())
    , neighbors(given.triangles.size(), { -1, -1, -1 })
  {
    std::unordered_map<std::uint64_t, std::pair<int, int>> open;
    for (std::size_t t = 0; t < given.triangles.size(); ++t)
    {
      const auto& corners = given.triangles[t];
      const Eigen::Vector3d& a = given.points[corners[0]];
      const Eigen::Vector3d normal =
        (given.points[corners[1]] - a).cross(given.points[corners[2]] - a);
      const double length = normal.norm();
      const bool usable = std::isfinite(length) && length > 0;
      this->areas[t] = usable ? length / 2 : 0;
      this->normals[t] = usable ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
      for (int side = 0; side < 3; ++side)
      {
        const std::uint64_t from = corners[side];
        const std::uint64_t to = corners[(side + 1) % 3];
        const auto other = open.find(to << 32 | from);
        if (other != open.end())
        {
          this->neighbors[t][side] = other->second.first;
          this->neighbors[other->second.first][other->second.second] = static_cast<int>(t);
          open.erase(other);
        }
        else
        {
          open[from << 32 | to] = { static_cast<int>(t), side };
        }
      }
    }
  }

  Eigen::Vector3d Corner(int triangle, int corner) const
  {
    return this->mesh.points[this->mesh.triangles[triangle][corner]];
  }
  Eigen::Vector3d Middle(int triangle) const
  {
    return (this->Corner(triangle, 0) + this->Corner(triangle, 1) + this->Corner(triangle, 2)) / 3;
  }
};

// Calls with column and row of the cells whose middles a flat triangle covers.
template <typename Visit>
void ForEachCell(const std::array<Eigen::Vector2d, 3>& corners, const Visit& visit)
{
  const double least = std::min({ corners[0].y(), corners[1].y(), corners[2].y() });
  const double most = std::max({ corners[0].y(), corners[1].y(), corners[2].y() });
  for (int row = static_cast<int>(std::ceil(least - 0.5)); row + 0.5 <= most; ++row)
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d& a = corners[i];
      const Eigen::Vector2d& b = corners[(i + 1) % 3];
      if (std::min(a.y(), b.y()) <= row + 0.5 && std::max(a.y(), b.y()) >= row + 0.5 &&
        a.y() != b.y())
      {
        const double x = a.x() + (row + 0.5 - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
    for (int column = static_cast<int>(std::ceil(low - 0.5)); column + 0.5 <= high; ++column)
    {
      visit(column, row);
    }
  }
}

// Triangles that a photograph sees at a corner or in the middle, and so many rings around them.
std::vector<char> SeenTriangles(
  const Geometry& geometry, const SurfaceColor& color, const ParallelFor& parallelFor)
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
        // Many points over a large triangle, the middle alone of one smaller than a pixel.
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

// The area-weighted median of what the photographs resolve.
double TexelOfPhotographs(const Geometry& geometry, const SurfaceColor& color)
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

/// Grows charts over the neighbours of their triangles.
class ChartCutter
{
public:
  ChartCutter(const Geometry& surface, const std::vector<char>& seenTriangles, double texelSide)
    : Surface(surface)
    , Texel(texelSide)
    , Free(seenTriangles)
  {
  }

  std::vector<Chart> Cut()
  {
    std::vector<int> seeds(this->Free.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    const auto worth = [&](int t)
    { return this->Surface.areas[t] * this->Surface.normals[t].cwiseAbs().maxCoeff(); };
    std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return worth(a) > worth(b); });
    std::vector<Chart> charts;
    for (const int seed : seeds)
    {
      if (this->Free[seed] && this->Surface.areas[seed] > 0)
      {
        charts.push_back(this->Grow(seed));
      }
    }
    return charts;
  }

private:
  Chart Grow(int seed)
  {
    Chart chart;
    const Eigen::Vector3d& normal = this->Surface.normals[seed];
    normal.cwiseAbs().maxCoeff(&chart.axis);
    chart.sign = normal[chart.axis] < 0 ? -1 : 1;
    this->Heights.clear();
    std::queue<int> waiting;
    waiting.push(seed);
    while (!waiting.empty())
    {
      const int triangle = waiting.front();
      waiting.pop();
      if (!this->Free[triangle] || !this->Fits(chart, triangle))
      {
        continue;
      }
      this->Free[triangle] = 0;
      chart.triangles.push_back(triangle);
      for (int corner = 0; corner < 3; ++corner)
      {
        const Eigen::Vector2d flat = chart.Flat(this->Surface.Corner(triangle, corner));
        chart.low = chart.low.cwiseMin(flat);
        chart.high = chart.high.cwiseMax(flat);
        const int neighbor = this->Surface.neighbors[triangle][corner];
        if (neighbor >= 0 && this->Free[neighbor])
        {
          waiting.push(neighbor);
        }
      }
    }
    return chart;
  }

  // Whether the triangle looks the chart's way and no other part of the chart is above or below it.
  bool Fits(const Chart& chart, int triangle)
  {
    const Eigen::Vector3d& normal = this->Surface.normals[triangle];
    if (!(chart.sign * normal[chart.axis] > LeastCosine) && !chart.triangles.empty())
    {
      return false;
    }
    std::array<Eigen::Vector2d, 3> flat;
    for (int i = 0; i < 3; ++i)
    {
      flat[i] = chart.Flat(this->Surface.Corner(triangle, i)) / this->Texel;
    }
    const float height = static_cast<float>(this->Surface.Middle(triangle)[chart.axis]);
    const double extent = (flat[0] - flat[1]).norm() + (flat[0] - flat[2]).norm();
    const float tolerance = static_cast<float>(this->Texel * (8 + 3 * extent));
    bool fits = true;
    ForEachCell(flat,
      [&](int column, int row)
      {
        const auto at = this->Heights.find(Cell(column, row));
        fits = fits && (at == this->Heights.end() || std::abs(at->second - height) < tolerance);
      });
    if (fits)
    {
      ForEachCell(
        flat, [&](int column, int row) { this->Heights.emplace(Cell(column, row), height); });
    }
    return fits;
  }

  static std::uint64_t Cell(int column, int row)
  {
    return std::uint64_t(std::uint32_t(column)) << 32 | std::uint32_t(row);
  }

  const Geometry& Surface;
  double Texel;
  std::vector<char> Free;
  std::unordered_map<std::uint64_t, float> Heights; // of the chart that grows
};

// On shelves, the highest charts first. Returns whether they fit into the largest atlas.
bool Pack(
  std::vector<Chart>& charts, double texel, const TextureAtlasOptions& options, TextureAtlas& atlas)
{
  std::vector<int> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  double area = 0;
  int widest = 1;
  for (Chart& chart : charts)
  {
    const Eigen::Vector2d size = (chart.high - chart.low) / texel;
    if (!(size.maxCoeff() < options.largest))
    {
      return false;
    }
    chart.width = static_cast<int>(std::ceil(size.x())) + 1 + 2 * options.gutter;
    chart.height = static_cast<int>(std::ceil(size.y())) + 1 + 2 * options.gutter;
    area += double(chart.width) * chart.height;
    widest = std::max(widest, chart.width);
  }
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return charts[a].height > charts[b].height; });
  const int square = static_cast<int>(std::min(1e6, std::ceil(std::sqrt(1.05 * area))));
  atlas.width = (std::max(widest, square) + 3) / 4 * 4;
  int column = 0;
  int row = 1; // the first row is for what is not seen
  int shelf = 0;
  for (const int i : order)
  {
    Chart& chart = charts[i];
    if (column + chart.width > atlas.width)
    {
      row += shelf;
      column = 0;
      shelf = 0;
    }
    chart.column = column;
    chart.row = row;
    column += chart.width;
    shelf = std::max(shelf, chart.height);
  }
  atlas.height = (row + shelf + 3) / 4 * 4;
  return atlas.width <= options.largest && atlas.height <= options.largest;
}

// Charts keep a few texels each, however coarse these are: too many never fit.
void CheckLargest(
  std::vector<Chart>& charts, const TextureAtlasOptions& options, TextureAtlas& atlas)
{
  double extent = 0;
  for (const Chart& chart : charts)
  {
    extent = std::max(extent, (chart.high - chart.low).maxCoeff());
  }
  if (!charts.empty() && !Pack(charts, extent > 0 ? 2 * extent : 1.0, options, atlas))
  {
    throw Error("The surface falls into " + std::to_string(charts.size()) +
      " charts, which no texture with a longest side of " + std::to_string(options.largest) +
      " holds.");
  }
}

/// Colours the texels of a packed atlas.
class Painter
{
public:
  Painter(const Geometry& surface, const std::vector<Chart>& packed, TextureAtlas& painted,
    const TextureAtlasOptions& settings)
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

  Eigen::Vector2d TexelOf(const Chart& chart, const Eigen::Vector3d& point) const
  {
    const Eigen::Vector2d inside = (chart.Flat(point) - chart.low) / this->Atlas.texel;
    return inside + Eigen::Vector2d(chart.column, chart.row) +
      Eigen::Vector2d::Constant(this->Options.gutter + 0.5);
  }

  void PaintRow(int row, const SurfaceColor& color)
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

  // Colours spread from texel to texel: through the charts, and into their gutters.
  void Spread()
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

private:
  void Claim(int index)
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

  // The point of the triangle's plane that is seen in the middle of the texel.
  Eigen::Vector3d PointAt(int column, int row, std::size_t at) const
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

  void SpreadFrom(std::size_t at, bool intoGutter, std::vector<std::size_t>& next)
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

  void Set(std::size_t at, const Eigen::Vector3d& color)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      this->Atlas.rgb[3 * at + channel] = static_cast<unsigned char>(color[channel] + 0.5);
    }
    this->Painted[at] = 1;
  }

  const Geometry& Surface;
  const std::vector<Chart>& Charts;
  TextureAtlas& Atlas;
  const TextureAtlasOptions& Options;
  std::vector<int> Owner;      // triangle of each texel, or -1
  std::vector<int> OwnerChart; // and its chart
  std::vector<char> Painted;
};

// Points of the atlas: one for each chart and point of the mesh in it.
void AddCoordinates(const Geometry& geometry, const std::vector<Chart>& charts,
  const Painter& painter, TextureAtlas& atlas)
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
  if (!(this->texel >= 0) || this->largest < 16 || this->gutter < 0 || this->gutter > 64)
  {
    throw Error(
      "A texture's texels must not be negative, its largest side at least 16 and its gutter "
      "from 0 to 64.");
  }
}

namespace
{

// Charts do not fill the atlas: what is asked for is refused where it cannot fit, and otherwise may become
// a little larger.
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
}

}

TextureAtlas BakeTexture(const TriangleMesh& mesh, const SurfaceColor& color,
  const TextureAtlasOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  TextureAtlas atlas;
  const Geometry geometry(mesh);
  const std::vector<char> seen = SeenTriangles(geometry, color, parallelFor);
  progress(0.1);
  atlas.texel = options.texel > 0 ? options.texel : TexelOfPhotographs(geometry, color);
  double seenArea = 0;
  for (std::size_t t = 0; t < seen.size(); ++t)
  {
    seenArea += seen[t] ? geometry.areas[t] : 0;
  }
  CheckTexel(options, seenArea);
  // Not so small that the charts could not fit, which would only cost time; 1 if there are none.
  const double smallest = std::sqrt(seenArea) / options.largest;
  atlas.texel = std::max(atlas.texel, smallest > 0 ? smallest : 1.0 * (atlas.texel == 0));
  std::vector<Chart> charts = ChartCutter(geometry, seen, atlas.texel).Cut();
  progress(0.3);
  CheckLargest(charts, options, atlas);
  while (!Pack(charts, atlas.texel, options, atlas))
  {
    atlas.texel *= 1.1;
  }
  atlas.charts = static_cast<int>(charts.size());
  atlas.rgb.resize(std::size_t(3) * atlas.width * atlas.height);
  for (std::size_t i = 0; i < atlas.rgb.size(); ++i)
  {
    atlas.rgb[i] = static_cast<unsigned char>(options.unseen[i % 3]);
  }
  Painter painter(geometry, charts, atlas, options);
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
