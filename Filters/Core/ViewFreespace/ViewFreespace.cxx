// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/ViewFreespace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();
constexpr int LongestWalk = 48;
constexpr std::int64_t MostCells = 1 << 23;
constexpr double CellsPerTriangle = 3.0;
constexpr double EdgeOnCosine = 0.0872; // of 85 degrees

// Relative room for the rounding between a cell's bounds and a triangle's disparity.
constexpr double Slack = 1e-6;

// Bounds in single precision, without the care of nextafter, which is called for each cell.
constexpr float Ulp = std::numeric_limits<float>::epsilon();

float RoundDown(double x)
{
  const float near = static_cast<float>(x);
  return near - std::abs(near) * Ulp;
}

float RoundUp(double x)
{
  const float near = static_cast<float>(x);
  return near + std::abs(near) * Ulp;
}

// Joins intervals that touch, but for the last bits, and hands on those that nothing can touch any more.
class IntervalJoiner
{
public:
  explicit IntervalJoiner(const ViewFreespace::IntervalVisitor& visit)
    : Visit(visit)
  {
  }

  // Some more, of which none begins before a place that none of the earlier ones lies beyond with its
  // beginning. False when enough were seen.
  bool Add(double from, ViewFreespace::Intervals& more)
  {
    if (this->IsOpen && !this->Touches(from) && !this->Close())
    {
      return false;
    }
    std::sort(more.begin(), more.end());
    for (const auto& interval : more)
    {
      if (this->IsOpen && this->Touches(interval.first))
      {
        this->Open.second = std::max(this->Open.second, interval.second);
      }
      else
      {
        if (this->IsOpen && !this->Close())
        {
          return false;
        }
        this->Open = interval;
        this->IsOpen = true;
      }
    }
    return true;
  }

  // There are no more.
  void Finish()
  {
    if (this->IsOpen)
    {
      this->Close();
    }
  }

private:
  bool Touches(double begin) const { return begin <= this->Open.second + 1e-13; }

  bool Close()
  {
    this->IsOpen = false;
    return this->Visit(this->Open.first, this->Open.second);
  }

  const ViewFreespace::IntervalVisitor& Visit;
  bool IsOpen = false;
  std::pair<double, double> Open;
};

}

ViewFreespace::ViewFreespace(const DisparityMap& map, const CancellationFlag& stop)
{
  this->RasterFromWorld << map.camera.K * map.camera.R, map.camera.K * map.camera.t;
  this->Eye = map.camera.Center();
  this->AddTriangles(map);
  if (this->Triangles.empty())
  {
    return;
  }
  ThrowIfCancelled(stop);
  this->SortByPlace();
  this->LinkNeighbors(stop);
  this->MakeRaster(stop);
  ThrowIfCancelled(stop);
  this->MakePyramid();
}

void ViewFreespace::AddTriangles(const DisparityMap& map)
{
  const std::size_t n = map.points.size();
  std::vector<char> usable(n, 0);
  this->Corners.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double depth = map.camera.Depth(map.points[i]);
    usable[i] = map.imagePoints[i].allFinite() && std::isfinite(depth) && depth > 0;
    this->Corners[i] = { map.imagePoints[i], 1.0 / depth };
  }
  Eigen::AlignedBox2d box;
  this->Triangles.reserve(map.triangles.size());
  for (std::size_t t = 0; t < map.triangles.size(); ++t)
  {
    std::array<int, 3> c = map.triangles[t];
    if (!usable[c[0]] || !usable[c[1]] || !usable[c[2]])
    {
      continue;
    }
    Triangle triangle;
    triangle.corner = c;
    triangle.neighbor = { -1, -1, -1 };
    triangle.id = static_cast<int>(t);
    this->Triangles.push_back(triangle);
    for (int i : c)
    {
      box.extend(this->Corners[i].position);
    }
  }
  if (this->Triangles.empty())
  {
    return;
  }
  // Square cells, some to each triangle.
  const Vector2d size = box.sizes().cwiseMax(1e-9 * (1.0 + box.sizes().maxCoeff()));
  const double wanted = std::min<double>(
    static_cast<double>(MostCells), CellsPerTriangle * this->Triangles.size() + 16.0);
  const double side = std::max(std::sqrt(size.prod() / wanted), size.maxCoeff() / (0.5 * wanted));
  this->Width = static_cast<int>(size.x() / side) + 1;
  this->Height = static_cast<int>(size.y() / side) + 1;
  const Eigen::RowVector4d depthRow = this->RasterFromWorld.row(2);
  for (int axis = 0; axis < 2; ++axis)
  {
    this->RasterFromWorld.row(axis) =
      (this->RasterFromWorld.row(axis) - box.min()[axis] * depthRow) / side;
  }
  for (Corner& corner : this->Corners)
  {
    corner.position = (corner.position - box.min()) / side;
  }
  // Turn all triangles the same way; drop those without area.
  const auto flat = [this](Triangle& t)
  {
    const Corner &a = this->Corners[t.corner[0]], &b = this->Corners[t.corner[1]],
                 &c = this->Corners[t.corner[2]];
    const Vector2d ab = b.position - a.position, ac = c.position - a.position;
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    const double ub = b.disparity - a.disparity, uc = c.disparity - a.disparity;
    t.slopeX = (ub * ac.y() - uc * ab.y()) / area;
    t.slopeY = (uc * ab.x() - ub * ac.x()) / area;
    if (area < 0)
    {
      std::swap(t.corner[1], t.corner[2]);
    }
    return area == 0 || !std::isfinite(t.slopeX) || !std::isfinite(t.slopeY);
  };
  this->Triangles.erase(
    std::remove_if(this->Triangles.begin(), this->Triangles.end(), flat), this->Triangles.end());
}

// Triangles and corners that are near to each other in the image come near to each other in memory: tile
// by tile of the raster. What is asked of them later mostly finds them in the cache.
void ViewFreespace::SortByPlace()
{
  constexpr double tile = 8; // cells
  const int columns = static_cast<int>(this->Width / tile) + 1;
  const int rows = static_cast<int>(this->Height / tile) + 1;
  const auto tileOf = [&](const Triangle& triangle)
  {
    const Vector2d& position = this->Corners[triangle.corner[0]].position;
    return static_cast<int>(position.y() / tile) * columns + static_cast<int>(position.x() / tile);
  };
  std::vector<int> next(static_cast<std::size_t>(columns) * rows + 1, 0);
  for (const Triangle& triangle : this->Triangles)
  {
    ++next[tileOf(triangle) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Triangle> sorted(this->Triangles.size());
  for (const Triangle& triangle : this->Triangles)
  {
    sorted[next[tileOf(triangle)]++] = triangle;
  }
  this->Triangles = std::move(sorted);
  std::vector<int> newIndex(this->Corners.size(), -1);
  std::vector<Corner> corners;
  corners.reserve(this->Corners.size());
  for (Triangle& triangle : this->Triangles)
  {
    for (int& corner : triangle.corner)
    {
      if (newIndex[corner] < 0)
      {
        newIndex[corner] = static_cast<int>(corners.size());
        corners.push_back(this->Corners[corner]);
      }
      corner = newIndex[corner];
    }
  }
  this->Corners = std::move(corners);
}

void ViewFreespace::LinkNeighbors(const CancellationFlag& stop)
{
  // The edges that begin at each corner, taken from their smaller corner.
  std::vector<int> begin(this->Corners.size() + 2, 0);
  const auto ends = [this](int side)
  {
    const auto& corner = this->Triangles[side / 3].corner;
    return std::minmax(corner[side % 3], corner[(side + 1) % 3]);
  };
  const int sides = 3 * static_cast<int>(this->Triangles.size());
  for (int side = 0; side < sides; ++side)
  {
    ++begin[ends(side).first + 2];
  }
  for (std::size_t i = 2; i < begin.size(); ++i)
  {
    begin[i] += begin[i - 1];
  }
  std::vector<int> bucket(sides);
  for (int side = 0; side < sides; ++side)
  {
    bucket[begin[ends(side).first + 1]++] = side;
  }
  for (std::size_t c = 0; c < this->Corners.size(); ++c)
  {
    ThrowIfCancelled(stop);
    for (int i = begin[c]; i < begin[c + 1]; ++i)
    {
      int& neighbor = this->Triangles[bucket[i] / 3].neighbor[bucket[i] % 3];
      for (int j = i + 1; j < begin[c + 1] && neighbor < 0; ++j)
      {
        int& other = this->Triangles[bucket[j] / 3].neighbor[bucket[j] % 3];
        if (other < 0 && ends(bucket[i]).second == ends(bucket[j]).second)
        {
          neighbor = bucket[j] / 3;
          other = bucket[i] / 3;
        }
      }
    }
  }
}

// Calls visit(row, first and last column, leftmost and rightmost place at the row's middle) for each row
// of cells that a small convex polygon touches: band by band over the rows of the raster, between the outermost points
// that the polygon's edges have in the band.
template <typename Visit>
void ViewFreespace::VisitRows(const Vector2d* polygon, int corners, Visit&& visit) const
{
  // A hair of room, so that a point is never rounded into a cell that its triangle was not told to.
  const double room = 1e-9 * (this->Width + this->Height);
  struct Side
  {
    double low, high; // of y
    double xLow, xHigh, slope;
  };
  std::array<Side, 3> sides;
  double bottom = HUGE_VAL, top = -HUGE_VAL;
  for (int i = 0; i < corners; ++i)
  {
    Vector2d a = polygon[i], b = polygon[i + 1 < corners ? i + 1 : 0];
    if (a.y() > b.y())
    {
      std::swap(a, b);
    }
    const double slope = a.y() == b.y() ? 0.0 : (b.x() - a.x()) / (b.y() - a.y());
    sides[i] = { a.y(), b.y(), a.x(), b.x(), slope };
    bottom = std::min(bottom, a.y());
    top = std::max(top, b.y());
  }
  const int first = std::clamp(static_cast<int>(bottom - room), 0, this->Height - 1);
  const int last = std::clamp(static_cast<int>(top + room), 0, this->Height - 1);
  for (int row = first; row <= last; ++row)
  {
    const double low = row - room, high = row + 1 + room, middle = row + 0.5;
    double left = HUGE_VAL, right = -HUGE_VAL, leftMiddle = HUGE_VAL, rightMiddle = -HUGE_VAL;
    for (int i = 0; i < corners; ++i)
    {
      const Side& side = sides[i];
      const double from = std::max(low, side.low), to = std::min(high, side.high);
      if (from > to)
      {
        continue;
      }
      const double xFrom = side.xLow + side.slope * (from - side.low);
      const double xTo =
        side.low == side.high ? side.xHigh : side.xLow + side.slope * (to - side.low);
      left = std::min({ left, xFrom, xTo });
      right = std::max({ right, xFrom, xTo });
      if (side.low <= middle && middle <= side.high)
      {
        const double x = side.xLow + side.slope * (middle - side.low);
        leftMiddle = std::min(leftMiddle, x);
        rightMiddle = std::max(rightMiddle, x);
      }
    }
    if (left <= right)
    {
      const int from = std::clamp(static_cast<int>(left - room), 0, this->Width - 1);
      const int to = std::clamp(static_cast<int>(right + room), 0, this->Width - 1);
      visit(row, from, to, leftMiddle, rightMiddle);
    }
  }
}

void ViewFreespace::MakeRaster(const CancellationFlag& stop)
{
  const std::size_t cells = static_cast<std::size_t>(this->Width) * this->Height;
  this->Cells.assign(cells, { Infinity, -Infinity, -1 });
  // A triangle's cells in a row.
  struct Run
  {
    int cell, count, triangle;
  };
  std::vector<Run> runs;
  runs.reserve(4 * this->Triangles.size());
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    ThrowIfCancelled(stop);
    const Triangle& triangle = this->Triangles[t];
    Vector2d polygon[3];
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < 3; ++i)
    {
      const Corner& corner = this->Corners[triangle.corner[i]];
      polygon[i] = corner.position;
      least = std::min(least, corner.disparity);
      most = std::max(most, corner.disparity);
    }
    const double reach = 0.5 * (std::abs(triangle.slopeX) + std::abs(triangle.slopeY));
    const Corner& origin = this->Corners[triangle.corner[0]];
    this->VisitRows(polygon, 3,
      [&](int row, int first, int last, double leftMiddle, double rightMiddle)
      {
        const int begin = row * this->Width + first;
        runs.push_back({ begin, last - first + 1, static_cast<int>(t) });
        for (int column = first; column <= last; ++column)
        {
          Cell& cell = this->Cells[begin + column - first];
          const double center = origin.disparity +
            triangle.slopeX * (column + 0.5 - origin.position.x()) +
            triangle.slopeY * (row + 0.5 - origin.position.y());
          const double low = std::clamp(center - reach, least, most);
          const double high = std::clamp(center + reach, least, most);
          cell.low = std::min(cell.low, RoundDown(low * (1 - Slack)));
          cell.high = std::max(cell.high, RoundUp(high * (1 + Slack)));
          const bool holdsCenter = leftMiddle <= column + 0.5 && column + 0.5 <= rightMiddle;
          if (cell.triangle < 0 || holdsCenter)
          {
            cell.triangle = static_cast<int>(t);
          }
        }
      });
  }
  ThrowIfCancelled(stop);
  // Where the border of the map passes, a cell is not wholly covered.
  for (const Triangle& triangle : this->Triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (triangle.neighbor[i] < 0)
      {
        const Vector2d edge[2] = { this->Corners[triangle.corner[i]].position,
          this->Corners[triangle.corner[(i + 1) % 3]].position };
        this->VisitRows(edge, 2,
          [&](int row, int first, int last, double, double)
          {
            for (int column = first; column <= last; ++column)
            {
              this->Cells[row * this->Width + column].high = Infinity;
            }
          });
      }
    }
  }
  for (Cell& cell : this->Cells)
  {
    cell.high = cell.triangle < 0 ? Infinity : cell.high;
  }
  ThrowIfCancelled(stop);
  this->ListBegin.assign(cells + 2, 0);
  for (const Run& run : runs)
  {
    for (int i = 0; i < run.count; ++i)
    {
      ++this->ListBegin[run.cell + i + 2];
    }
  }
  std::partial_sum(this->ListBegin.begin(), this->ListBegin.end(), this->ListBegin.begin());
  this->List.resize(this->ListBegin.back());
  for (const Run& run : runs)
  {
    for (int i = 0; i < run.count; ++i)
    {
      this->List[this->ListBegin[run.cell + i + 1]++] = run.triangle;
    }
  }
}

void ViewFreespace::MakePyramid()
{
  Level level{ this->Width, this->Height, {} };
  level.bounds.reserve(this->Cells.size());
  for (const Cell& cell : this->Cells)
  {
    level.bounds.emplace_back(cell.low, cell.high);
  }
  while (true)
  {
    this->Pyramid.push_back(std::move(level));
    const Level& fine = this->Pyramid.back();
    if (fine.width == 1 && fine.height == 1)
    {
      return;
    }
    Level coarse{ (fine.width + 1) / 2, (fine.height + 1) / 2, {} };
    // What lies beyond the raster is not covered.
    coarse.bounds.assign(
      static_cast<std::size_t>(coarse.width) * coarse.height, { Infinity, -Infinity });
    for (int y = 0; y < fine.height; ++y)
    {
      for (int x = 0; x < fine.width; ++x)
      {
        const auto& from = fine.bounds[static_cast<std::size_t>(y) * fine.width + x];
        auto& to = coarse.bounds[static_cast<std::size_t>(y / 2) * coarse.width + x / 2];
        to.first = std::min(to.first, from.first);
        to.second = std::max(to.second, from.second);
      }
    }
    level = std::move(coarse);
  }
}

bool ViewFreespace::Project(const Vector3d& point, Pixel& pixel) const
{
  const Vector3d q = this->Raster(point);
  pixel = { q.x() / q.z(), q.y() / q.z(), q.z() };
  return q.z() > 0 && pixel.x >= 0 && pixel.y >= 0 && pixel.x < this->Width &&
    pixel.y < this->Height;
}

// Twice the area of the triangle from an edge to a point. The edge is always taken from its smaller
// corner, so that the two triangles beside it see exactly opposite values.
double ViewFreespace::Turn(int a, int b, double x, double y) const
{
  const bool reversed = a > b;
  const Vector2d& p = this->Corners[reversed ? b : a].position;
  const Vector2d& q = this->Corners[reversed ? a : b].position;
  const double turn = (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
  return reversed ? -turn : turn;
}

// Walks over the edges that have the point beyond them, to the point's triangle or to the border.
ViewFreespace::Walk ViewFreespace::WalkTo(double x, double y, int start) const
{
  int at = start, from = -1;
  for (int step = 0; step < LongestWalk; ++step)
  {
    const Triangle& triangle = this->Triangles[at];
    int crossed = -1;
    for (int i = 0; i < 3 && crossed < 0; ++i)
    {
      const int neighbor = triangle.neighbor[i];
      if ((neighbor != from || neighbor < 0) &&
        this->Turn(triangle.corner[i], triangle.corner[(i + 1) % 3], x, y) < 0)
      {
        crossed = i;
      }
    }
    if (crossed < 0 || triangle.neighbor[crossed] < 0)
    {
      return { true, at, crossed };
    }
    from = at;
    at = triangle.neighbor[crossed];
  }
  return { false, at, -1 };
}

// The triangle in the cell's list that holds the point, or -1.
int ViewFreespace::LocateInCell(double x, double y) const
{
  const std::size_t cell = this->CellAt(x, y);
  for (int i = this->ListBegin[cell]; i < this->ListBegin[cell + 1]; ++i)
  {
    const auto& corner = this->Triangles[this->List[i]].corner;
    if (this->Turn(corner[0], corner[1], x, y) >= 0 &&
      this->Turn(corner[1], corner[2], x, y) >= 0 && this->Turn(corner[2], corner[0], x, y) >= 0)
    {
      return this->List[i];
    }
  }
  return -1;
}

int ViewFreespace::Find(const Pixel& pixel) const
{
  const Cell& cell = this->Cells[static_cast<std::size_t>(static_cast<int>(pixel.y)) * this->Width +
    static_cast<int>(pixel.x)];
  if (cell.triangle < 0)
  {
    return -1;
  }
  const Walk walk = this->WalkTo(pixel.x, pixel.y, cell.triangle);
  if (walk.ended && walk.border < 0)
  {
    return walk.triangle;
  }
  // Out over a border, which in a map with holes or bays proves nothing; or a walk too long. A cell
  // without border is covered: there the walk's start stands in, should rounding lose the point.
  const int found = this->LocateInCell(pixel.x, pixel.y);
  return found < 0 && cell.high < Infinity ? cell.triangle : found;
}

double ViewFreespace::Disparity(const Triangle& triangle, double x, double y) const
{
  const Corner& a = this->Corners[triangle.corner[0]];
  const double u = this->Corners[triangle.corner[1]].disparity;
  const double v = this->Corners[triangle.corner[2]].disparity;
  const double disparity =
    a.disparity + triangle.slopeX * (x - a.position.x()) + triangle.slopeY * (y - a.position.y());
  return std::clamp(disparity, std::min({ a.disparity, u, v }), std::max({ a.disparity, u, v }));
}

ViewFreespace::Sample ViewFreespace::At(const Vector3d& point) const
{
  Sample sample;
  Pixel pixel;
  if (!this->Project(point, pixel))
  {
    return sample;
  }
  const int found = this->Find(pixel);
  if (found < 0)
  {
    return sample;
  }
  const Triangle& triangle = this->Triangles[found];
  const double disparity = this->Disparity(triangle, pixel.x, pixel.y);
  sample.triangle = triangle.id;
  sample.value = 1.0 / disparity - pixel.depth;
  // The map's depth is 1 / disparity, and disparity is linear in the pixel.
  const auto row = [this](int i) { return this->RasterFromWorld.row(i).head<3>().transpose(); };
  const Vector3d pixelX = (row(0) - pixel.x * row(2)) / pixel.depth;
  const Vector3d pixelY = (row(1) - pixel.y * row(2)) / pixel.depth;
  sample.gradient =
    -(triangle.slopeX * pixelX + triangle.slopeY * pixelY) / (disparity * disparity) - row(2);
  return sample;
}

bool ViewFreespace::IsFree(const Vector3d& point) const
{
  Pixel pixel;
  if (!this->Project(point, pixel))
  {
    return false;
  }
  const Cell& cell = this->Cells[static_cast<std::size_t>(static_cast<int>(pixel.y)) * this->Width +
    static_cast<int>(pixel.x)];
  if (cell.high * pixel.depth < 1.0)
  {
    return true;
  }
  if (cell.low * pixel.depth > 1.0)
  {
    return false;
  }
  const int found = this->Find(pixel);
  return found >= 0 &&
    this->Disparity(this->Triangles[found], pixel.x, pixel.y) * pixel.depth < 1.0;
}

Vector3d ViewFreespace::WallNormal(const Vector3d& claimed, const Vector3d& beyond) const
{
  Pixel from, to;
  const bool inRaster = this->Project(claimed, from);
  const int start = inRaster ? this->Find(from) : -1;
  const Vector3d q = this->Raster(beyond);
  to = { q.x() / q.z(), q.y() / q.z(), q.z() };
  if (start >= 0 && to.depth > 0)
  {
    const Walk walk = this->WalkTo(to.x, to.y, start);
    if (walk.border >= 0)
    {
      const auto& corner = this->Triangles[walk.triangle].corner;
      const Vector2d& a = this->Corners[corner[walk.border]].position;
      const Vector2d& b = this->Corners[corner[(walk.border + 1) % 3]].position;
      // Triangles turn positively, so the line's positive side is the claimed one.
      const Vector3d line = a.homogeneous().cross(b.homogeneous());
      return (this->RasterFromWorld.leftCols<3>().transpose() * line).normalized();
    }
  }
  return (claimed - beyond).normalized();
}

// The line through two corners as a homogeneous 3-vector, always from the smaller corner, see Turn.
Vector3d ViewFreespace::LineThrough(int a, int b) const
{
  const Vector2d& p = this->Corners[std::min(a, b)].position;
  const Vector2d& q = this->Corners[std::max(a, b)].position;
  const Vector3d line(p.y() - q.y(), q.x() - p.x(), p.x() * q.y() - q.x() * p.y());
  return a < b ? line : Vector3d(-line);
}

// The disparity of a triangle as a form on homogeneous raster coordinates: a point is in front of it
// where the form is below 1.
Vector3d ViewFreespace::PlaneOf(const Triangle& triangle) const
{
  const Corner& corner = this->Corners[triangle.corner[0]];
  return Vector3d(triangle.slopeX, triangle.slopeY,
    corner.disparity - triangle.slopeX * corner.position.x() -
      triangle.slopeY * corner.position.y());
}

// Narrows a range of a segment, given in raster coordinates, to what is over a triangle and in front
// of it. Homogeneous coordinates are linear along the segment, and so are the tests.
void ViewFreespace::ClipToTriangle(const Triangle& triangle, const Vector3d& first,
  const Vector3d& last, double& begin, double& end) const
{
  const auto clip = [&](double atFirst, double atLast)
  {
    if (atFirst < 0 && atLast < 0)
    {
      end = -1;
    }
    else if (atFirst < 0)
    {
      begin = std::max(begin, atFirst / (atFirst - atLast));
    }
    else if (atLast < 0)
    {
      end = std::min(end, atFirst / (atFirst - atLast));
    }
  };
  const Vector3d plane = this->PlaneOf(triangle);
  clip(1.0 - plane.dot(first), 1.0 - plane.dot(last));
  for (int i = 0; i < 3 && begin <= end; ++i)
  {
    const Vector3d line = this->LineThrough(triangle.corner[i], triangle.corner[(i + 1) % 3]);
    clip(line.dot(first), line.dot(last));
  }
}

/// The way of a segment over the raster, cell by cell, or block by block where it is far from the map.
class ViewFreespace::SegmentWalk
{
public:
  SegmentWalk(const ViewFreespace& view, const Vector3d& first, const Vector3d& last)
    : View(view)
    , First(first)
    , Last(last)
    , Size{ view.Width, view.Height }
  {
    this->ClipToRaster();
    if (this->IsOverRaster())
    {
      this->CellAt(this->Here, this->At);
      this->CellAt(this->End, this->Goal);
    }
  }

  bool IsOverRaster() const { return this->Here <= this->End && !this->View.Triangles.empty(); }

  // Hands all that is free to the joiner.
  void Run(IntervalJoiner& joiner)
  {
    Intervals intervals;
    for (bool hasMore = true; hasMore;)
    {
      const double from = this->Here;
      intervals.clear();
      Step step = this->StepOver(BlockLevel);
      const bool isFar = this->CellsToGo() > BlockSize;
      if (!isFar || !this->IsDecided(step, intervals))
      {
        step = this->StepOver(0);
        this->View.AddFreeInCell(
          static_cast<std::size_t>(this->At[1]) * this->Size[0] + this->At[0], this->First,
          this->Last, this->Here, step.next, intervals);
      }
      if (!joiner.Add(from, intervals))
      {
        return;
      }
      hasMore = step.axis >= 0;
      this->Take(step);
    }
    joiner.Finish();
  }

private:
  static constexpr int BlockLevel = 3; // of the pyramid
  static constexpr int BlockSize = 1 << BlockLevel;

  // Out of a square of cells: where, and over which side; none where the segment ends in it.
  struct Step
  {
    int level;
    double next;
    int axis;
  };

  // The part that is in front of the camera and over the raster.
  void ClipToRaster()
  {
    const Vector3d &first = this->First, &last = this->Last;
    const auto clip = [this](double atFirst, double atLast)
    {
      const double crossing = atFirst / (atFirst - atLast);
      this->Here = atFirst < 0 ? std::max(this->Here, atLast < 0 ? 2.0 : crossing) : this->Here;
      this->End = atLast < 0 ? std::min(this->End, atFirst < 0 ? -1.0 : crossing) : this->End;
    };
    const double near = 1e-9 * std::max(std::abs(first.z()), std::abs(last.z()));
    clip(first.z() - near, last.z() - near);
    for (int axis = 0; axis < 2; ++axis)
    {
      clip(first[axis], last[axis]);
      clip(this->Size[axis] * first.z() - first[axis], this->Size[axis] * last.z() - last[axis]);
    }
  }

  void CellAt(double place, int cell[2]) const
  {
    const Vector2d pixel = (this->First + place * (this->Last - this->First)).hnormalized();
    for (int axis = 0; axis < 2; ++axis)
    {
      cell[axis] = std::clamp(static_cast<int>(pixel[axis]), 0, this->Size[axis] - 1);
    }
  }

  int CellsToGo() const
  {
    return std::abs(this->Goal[0] - this->At[0]) + std::abs(this->Goal[1] - this->At[1]);
  }

  Step StepOver(int level) const
  {
    Step step{ level, this->End, -1 };
    for (int axis = 0; axis < 2; ++axis)
    {
      const int square = this->At[axis] >> level, goal = this->Goal[axis] >> level;
      if (square != goal)
      {
        const double border = (square + (goal > square ? 1 : 0)) << level;
        const double a = this->First[axis] - border * this->First.z();
        const double b = this->Last[axis] - border * this->Last.z();
        const double crossing = std::clamp(a / (a - b), this->Here, this->End);
        if (step.axis < 0 || crossing < step.next)
        {
          step.next = crossing;
          step.axis = axis;
        }
      }
    }
    return step;
  }

  // Whether the way over a block is free, or not free, as a whole.
  bool IsDecided(const Step& step, Intervals& intervals) const
  {
    if (this->View.Pyramid.size() <= BlockLevel)
    {
      return false;
    }
    const Level& blocks = this->View.Pyramid[BlockLevel];
    const auto [low, high] =
      blocks.bounds[static_cast<std::size_t>(this->At[1] >> BlockLevel) * blocks.width +
        (this->At[0] >> BlockLevel)];
    const double depthBegin = this->First.z() + this->Here * (this->Last.z() - this->First.z());
    const double depthEnd = this->First.z() + step.next * (this->Last.z() - this->First.z());
    if (high * std::max(depthBegin, depthEnd) < 1.0)
    {
      intervals.emplace_back(this->Here, step.next);
      return true;
    }
    return low * std::min(depthBegin, depthEnd) > 1.0;
  }

  void Take(const Step& step)
  {
    if (step.axis < 0)
    {
      return;
    }
    this->Here = step.next;
    const int axis = step.axis, other = 1 - axis;
    const int square = this->At[axis] >> step.level;
    this->At[axis] =
      this->Goal[axis] > this->At[axis] ? (square + 1) << step.level : (square << step.level) - 1;
    if (step.level > 0)
    {
      // Along the block's side, never back nor beyond the goal.
      int cell[2];
      this->CellAt(this->Here, cell);
      const auto [least, most] = std::minmax(this->At[other], this->Goal[other]);
      const int low = (this->At[other] >> step.level) << step.level;
      this->At[other] =
        std::clamp(cell[other], std::max(least, low), std::min(most, low + (1 << step.level) - 1));
    }
  }

  const ViewFreespace& View;
  const Vector3d First, Last;
  const int Size[2];
  double Here = 0.0, End = 1.0;
  int At[2] = { 0, 0 }, Goal[2] = { 0, 0 };
};

void ViewFreespace::VisitFreeIntervals(
  const Vector3d& first, const Vector3d& last, const IntervalVisitor& visit) const
{
  SegmentWalk walk(*this, this->Raster(first), this->Raster(last));
  if (walk.IsOverRaster())
  {
    IntervalJoiner joiner(visit);
    walk.Run(joiner);
  }
}

void ViewFreespace::FreeIntervals(
  const Vector3d& first, const Vector3d& last, Intervals& intervals) const
{
  intervals.clear();
  this->VisitFreeIntervals(first, last,
    [&intervals](double begin, double end)
    {
      intervals.emplace_back(begin, end);
      return true;
    });
}

// The free part of the range of a segment that lies over one cell.
void ViewFreespace::AddFreeInCell(std::size_t index, const Vector3d& first, const Vector3d& last,
  double begin, double end, Intervals& intervals) const
{
  const Cell& cell = this->Cells[index];
  if (cell.triangle < 0)
  {
    return;
  }
  const double depthBegin = first.z() + begin * (last.z() - first.z());
  const double depthEnd = first.z() + end * (last.z() - first.z());
  if (cell.high * std::max(depthBegin, depthEnd) < 1.0)
  {
    intervals.emplace_back(begin, end);
    return;
  }
  if (cell.low * std::min(depthBegin, depthEnd) > 1.0)
  {
    return;
  }
  for (int i = this->ListBegin[index]; i < this->ListBegin[index + 1]; ++i)
  {
    double from = begin, to = end;
    this->ClipToTriangle(this->Triangles[this->List[i]], first, last, from, to);
    if (from < to)
    {
      intervals.emplace_back(from, to);
    }
  }
}

bool ViewFreespace::IsEdgeOn(const Vector3d& point, const Vector3d& normal) const
{
  const Vector3d ray = point - this->Eye;
  return std::abs(ray.dot(normal)) < EdgeOnCosine * ray.norm() * normal.norm();
}

ViewFreespace::Footprint ViewFreespace::FootprintOf(const Eigen::AlignedBox3d& box) const
{
  Footprint print = {};
  const Vector3d half = 0.5 * box.sizes();
  const Vector3d center = this->Raster(box.center());
  const Eigen::RowVector3d depthRow = this->RasterFromWorld.row(2).head<3>();
  const double depthReach = depthRow.cwiseAbs().dot(half) + 1e-12 * std::abs(center.z());
  print.nearest = center.z() - depthReach;
  print.furthest = center.z() + depthReach;
  print.isBehind = print.furthest <= 0;
  print.isAround = print.nearest <= 1e-3 * print.furthest;
  if (print.isBehind || print.isAround)
  {
    return print;
  }
  // How far the box reaches in the image from its centre's pixel: the centre's own perspective is
  // taken out first, so that what remains is of the box's size.
  const int size[2] = { this->Width, this->Height };
  print.isWithin = true;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double pixel = center[axis] / center.z();
    const Eigen::RowVector3d row = this->RasterFromWorld.row(axis).head<3>() - pixel * depthRow;
    const double reach = row.cwiseAbs().dot(half) / print.nearest + 1e-9 * (1 + std::abs(pixel));
    print.isBehind = print.isBehind || pixel + reach < 0 || pixel - reach >= size[axis];
    print.isWithin = print.isWithin && pixel - reach >= 0 && pixel + reach < size[axis];
    print.low[axis] = static_cast<int>(std::clamp(pixel - reach, 0.0, size[axis] - 1.0));
    print.high[axis] = static_cast<int>(std::clamp(pixel + reach, 0.0, size[axis] - 1.0));
  }
  return print;
}

BoxContent ViewFreespace::Classify(const Eigen::AlignedBox3d& box) const
{
  const Footprint print = this->FootprintOf(box);
  if (this->Triangles.empty() || print.isBehind)
  {
    return BoxContent::Matter;
  }
  if (print.isAround)
  {
    return BoxContent::Mixed;
  }
  // The level at which the box's image spans a few cells.
  std::size_t level = 0;
  while (level + 1 < this->Pyramid.size() &&
    std::max((print.high[0] >> level) - (print.low[0] >> level),
      (print.high[1] >> level) - (print.low[1] >> level)) > 3)
  {
    ++level;
  }
  const Level& cells = this->Pyramid[level];
  float least = Infinity, most = print.isWithin ? -Infinity : Infinity;
  for (int y = print.low[1] >> level; y <= print.high[1] >> level; ++y)
  {
    for (int x = print.low[0] >> level; x <= print.high[0] >> level; ++x)
    {
      const auto& bounds = cells.bounds[static_cast<std::size_t>(y) * cells.width + x];
      least = std::min(least, bounds.first);
      most = std::max(most, bounds.second);
    }
  }
  if (most * print.furthest < 1.0)
  {
    return BoxContent::Free;
  }
  return least * print.nearest > 1.0 ? BoxContent::Matter : BoxContent::Mixed;
}

BoxContent ViewFreespace::ClassifyFinely(const Eigen::AlignedBox3d& box) const
{
  const Footprint print = this->FootprintOf(box);
  if (this->Triangles.empty() || print.isBehind)
  {
    return BoxContent::Matter;
  }
  if (print.isAround || print.high[0] - print.low[0] > 3 || print.high[1] - print.low[1] > 3)
  {
    return BoxContent::Mixed;
  }
  // Homogeneous forms are linear in space too: each takes its extremes over the box at corners.
  const Vector3d center = this->Raster(box.center()), half = 0.5 * box.sizes();
  const auto reach = [&](const Vector3d& form)
  {
    return (this->RasterFromWorld.leftCols<3>().transpose() * form).cwiseAbs().dot(half) +
      1e-12 * form.cwiseAbs().dot(center.cwiseAbs());
  };
  bool isTouched = false, isFree = true, isMatter = true;
  for (int row = print.low[1]; row <= print.high[1]; ++row)
  {
    for (int column = print.low[0]; column <= print.high[0]; ++column)
    {
      const std::size_t cell = static_cast<std::size_t>(row) * this->Width + column;
      for (int i = this->ListBegin[cell]; i < this->ListBegin[cell + 1]; ++i)
      {
        const Triangle& triangle = this->Triangles[this->List[i]];
        bool isBeside = false, isOverBorder = false;
        for (int side = 0; side < 3; ++side)
        {
          const Vector3d line =
            this->LineThrough(triangle.corner[side], triangle.corner[(side + 1) % 3]);
          const double inside = line.dot(center), across = reach(line);
          isBeside = isBeside || inside + across < 0;
          isOverBorder = isOverBorder || (triangle.neighbor[side] < 0 && inside - across < 0);
        }
        if (isBeside)
        {
          continue;
        }
        const Vector3d plane = this->PlaneOf(triangle);
        const double at = plane.dot(center), across = reach(plane);
        isTouched = true;
        isFree = isFree && !isOverBorder && at + across < 1.0;
        isMatter = isMatter && at - across > 1.0;
      }
    }
  }
  // Not every triangle taken for touched is so. But where the centre is claimed and no border passes,
  // all of the box is.
  if (isTouched && isFree && this->At(box.center()).triangle >= 0)
  {
    return BoxContent::Free;
  }
  return isMatter ? BoxContent::Matter : BoxContent::Mixed;
}

}
