// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/DisparityRaster.h"

#include <cmath>
#include <limits>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

// Relative tolerance for the rounding between a cell's bounds and a triangle's disparity.
constexpr double Slack = 1e-6;

// For rounding bounds to single precision, faster than nextafter, as it is done for each cell.
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

// Calls visit(row, first column, last column, left, right) for each row of cells that a small
// convex polygon touches, where left and right bound the polygon at the row's middle. The columns
// are those between the outermost points that the polygon's edges have in the row.
template <typename Visit>
void VisitRows(const Vector2d* polygon, int corners, int width, int height, Visit&& visit)
{
  // A margin, so that rounding never puts a point into a cell that does not list its triangle.
  const double room = 1e-9 * (width + height);
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
  const int first = std::clamp(static_cast<int>(bottom - room), 0, height - 1);
  const int last = std::clamp(static_cast<int>(top + room), 0, height - 1);
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
      const int from = std::clamp(static_cast<int>(left - room), 0, width - 1);
      const int to = std::clamp(static_cast<int>(right + room), 0, width - 1);
      visit(row, from, to, leftMiddle, rightMiddle);
    }
  }
}

}

DisparityRaster::DisparityRaster(const DisparityMap& map, const CancellationFlag& stop)
  : TriangleMesh(map, stop)
{
  if (!this->IsEmpty())
  {
    this->FillCells(stop);
    ThrowIfCancelled(stop);
    this->MakePyramid();
  }
}

void DisparityRaster::FillCells(const CancellationFlag& stop)
{
  const std::size_t cells = static_cast<std::size_t>(this->Mesh().Width()) * this->Mesh().Height();
  this->Cells.assign(cells, { Infinity, -Infinity, -1 });
  std::vector<Run> runs;
  runs.reserve(4 * this->Mesh().Triangles().size());
  for (std::size_t t = 0; t < this->Mesh().Triangles().size(); ++t)
  {
    ThrowIfCancelled(stop);
    this->Rasterize(static_cast<int>(t), runs);
  }
  ThrowIfCancelled(stop);
  this->UnboundBorder();
  ThrowIfCancelled(stop);
  this->Lists = GroupedLists<int>(cells,
    [&runs](const auto& add)
    {
      for (const Run& run : runs)
      {
        for (int i = 0; i < run.count; ++i)
        {
          add(run.cell + i, run.triangle);
        }
      }
    });
}

// Updates the bounds of the cells that a triangle touches, and adds them to the runs.
void DisparityRaster::Rasterize(int t, std::vector<Run>& runs)
{
  const RasterMesh::Triangle& triangle = this->Mesh().Triangles()[t];
  Vector2d polygon[3];
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int i = 0; i < 3; ++i)
  {
    const RasterMesh::Corner& corner = this->Mesh().Corners()[triangle.corner[i]];
    polygon[i] = corner.position;
    least = std::min(least, corner.disparity);
    most = std::max(most, corner.disparity);
  }
  const double reach = 0.5 * (std::abs(triangle.slopeX) + std::abs(triangle.slopeY));
  const RasterMesh::Corner& origin = this->Mesh().Corners()[triangle.corner[0]];
  VisitRows(polygon, 3, this->Mesh().Width(), this->Mesh().Height(),
    [&](int row, int first, int last, double leftMiddle, double rightMiddle)
    {
      const int begin = row * this->Mesh().Width() + first;
      runs.push_back({ begin, last - first + 1, t });
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
          cell.triangle = t;
        }
      }
    });
}

// Removes the upper bound of the cells that are not wholly covered: those on the border of the map,
// and the empty ones.
void DisparityRaster::UnboundBorder()
{
  for (const RasterMesh::Triangle& triangle : this->Mesh().Triangles())
  {
    for (int i = 0; i < 3; ++i)
    {
      if (triangle.neighbor[i] < 0)
      {
        const Vector2d edge[2] = { this->Mesh().Corners()[triangle.corner[i]].position,
          this->Mesh().Corners()[triangle.corner[(i + 1) % 3]].position };
        VisitRows(edge, 2, this->Mesh().Width(), this->Mesh().Height(),
          [&](int row, int first, int last, double, double)
          {
            for (int column = first; column <= last; ++column)
            {
              this->Cells[row * this->Mesh().Width() + column].high = Infinity;
            }
          });
      }
    }
  }
  for (Cell& cell : this->Cells)
  {
    cell.high = cell.triangle < 0 ? Infinity : cell.high;
  }
}

void DisparityRaster::MakePyramid()
{
  Level level{ this->Mesh().Width(), this->Mesh().Height(), {} };
  level.bounds.reserve(this->Cells.size());
  for (const Cell& cell : this->Cells)
  {
    level.bounds.emplace_back(cell.low, cell.high);
  }
  while (true)
  {
    this->Levels.push_back(std::move(level));
    const Level& fine = this->Levels.back();
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

// The triangle in the cell's list that contains the pixel, or -1.
int DisparityRaster::LocateInCell(double x, double y) const
{
  const std::size_t cell = this->CellAt(x, y);
  for (const int triangle : this->Lists[cell])
  {
    const auto& corner = this->Mesh().Triangles()[triangle].corner;
    if (this->Mesh().Turn(corner[0], corner[1], x, y) >= 0 &&
      this->Mesh().Turn(corner[1], corner[2], x, y) >= 0 &&
      this->Mesh().Turn(corner[2], corner[0], x, y) >= 0)
    {
      return triangle;
    }
  }
  return -1;
}

int DisparityRaster::Find(const RasterMesh::Pixel& pixel) const
{
  const Cell& cell = this->Cells[this->CellAt(pixel.x, pixel.y)];
  if (cell.triangle < 0)
  {
    return -1;
  }
  const RasterMesh::Walk walk = this->Mesh().WalkTo(pixel.x, pixel.y, cell.triangle);
  if (walk.ended && walk.border < 0)
  {
    return walk.triangle;
  }
  // The walk left the map, which proves nothing where the map is not convex, or grew too long. A
  // cell without a border is covered: if rounding loses the pixel there, the cell's triangle stands
  // in.
  const int found = this->LocateInCell(pixel.x, pixel.y);
  return found < 0 && cell.high < Infinity ? cell.triangle : found;
}

DisparityRaster::Footprint DisparityRaster::FootprintOf(const Eigen::AlignedBox3d& box) const
{
  Footprint print = {};
  const Vector3d half = 0.5 * box.sizes();
  const Vector3d center = this->Mesh().Raster(box.center());
  const Eigen::RowVector3d depthRow = this->Mesh().RasterFromWorld().row(2).head<3>();
  const double depthReach = depthRow.cwiseAbs().dot(half) + 1e-12 * std::abs(center.z());
  print.nearest = center.z() - depthReach;
  print.furthest = center.z() + depthReach;
  print.isBehind = print.furthest <= 0;
  print.isAround = print.nearest <= 1e-3 * print.furthest;
  if (print.isBehind || print.isAround)
  {
    return print;
  }
  // The box's extent in the image around its centre's pixel. The centre's perspective is subtracted
  // first, so that the remainder is of the box's size.
  const int size[2] = { this->Mesh().Width(), this->Mesh().Height() };
  print.isWithin = true;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double pixel = center[axis] / center.z();
    const Eigen::RowVector3d row =
      this->Mesh().RasterFromWorld().row(axis).head<3>() - pixel * depthRow;
    const double reach = row.cwiseAbs().dot(half) / print.nearest + 1e-9 * (1 + std::abs(pixel));
    print.isBehind = print.isBehind || pixel + reach < 0 || pixel - reach >= size[axis];
    print.isWithin = print.isWithin && pixel - reach >= 0 && pixel + reach < size[axis];
    print.low[axis] = static_cast<int>(std::clamp(pixel - reach, 0.0, size[axis] - 1.0));
    print.high[axis] = static_cast<int>(std::clamp(pixel + reach, 0.0, size[axis] - 1.0));
  }
  return print;
}

BoxContent DisparityRaster::Classify(const Eigen::AlignedBox3d& box) const
{
  const Footprint print = this->FootprintOf(box);
  if (this->IsEmpty() || print.isBehind)
  {
    return BoxContent::Matter;
  }
  if (print.isAround)
  {
    return BoxContent::Mixed;
  }
  // The level at which the footprint spans a few cells.
  std::size_t level = 0;
  while (level + 1 < this->Levels.size() &&
    std::max((print.high[0] >> level) - (print.low[0] >> level),
      (print.high[1] >> level) - (print.low[1] >> level)) > 3)
  {
    ++level;
  }
  const Level& cells = this->Levels[level];
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

// Whether a box is in front of or behind the triangles that it touches in the image.
class DisparityRaster::BoxTest
{
public:
  BoxTest(const RasterMesh& mesh, const Eigen::AlignedBox3d& box)
    : Mesh(mesh)
    , Center(mesh.Raster(box.center()))
    , Half(0.5 * box.sizes())
  {
  }

  void Add(const RasterMesh::Triangle& triangle)
  {
    bool isBeside = false, isOverBorder = false;
    for (int side = 0; side < 3; ++side)
    {
      const Vector3d line =
        this->Mesh.LineThrough(triangle.corner[side], triangle.corner[(side + 1) % 3]);
      const double inside = line.dot(this->Center), across = this->Reach(line);
      isBeside = isBeside || inside + across < 0;
      isOverBorder = isOverBorder || (triangle.neighbor[side] < 0 && inside - across < 0);
    }
    if (isBeside)
    {
      return;
    }
    const Vector3d plane = this->Mesh.PlaneOf(triangle);
    const double at = plane.dot(this->Center), across = this->Reach(plane);
    this->IsTouched = true;
    this->IsFree = this->IsFree && !isOverBorder && at + across < 1.0;
    this->IsMatter = this->IsMatter && at - across > 1.0;
  }

  bool IsTouched = false, IsFree = true, IsMatter = true;

private:
  // The greatest difference of a homogeneous form within the box to its value at the centre. The
  // form is linear in space too, so that it has its extremes at the box's corners.
  double Reach(const Vector3d& form) const
  {
    return (this->Mesh.RasterFromWorld().leftCols<3>().transpose() * form)
             .cwiseAbs()
             .dot(this->Half) +
      1e-12 * form.cwiseAbs().dot(this->Center.cwiseAbs());
  }

  const RasterMesh& Mesh;
  const Vector3d Center, Half;
};

BoxContent DisparityRaster::ClassifyFinely(const Eigen::AlignedBox3d& box) const
{
  const Footprint print = this->FootprintOf(box);
  if (this->IsEmpty() || print.isBehind)
  {
    return BoxContent::Matter;
  }
  if (print.isAround || print.high[0] - print.low[0] > 3 || print.high[1] - print.low[1] > 3)
  {
    return BoxContent::Mixed;
  }
  BoxTest test(this->Mesh(), box);
  for (int row = print.low[1]; row <= print.high[1]; ++row)
  {
    for (int column = print.low[0]; column <= print.high[0]; ++column)
    {
      const std::size_t cell = static_cast<std::size_t>(row) * this->Mesh().Width() + column;
      for (const int triangle : this->Lists[cell])
      {
        test.Add(this->Mesh().Triangles()[triangle]);
      }
    }
  }
  // Touched is conservative. But if the centre is inside a triangle and the border is not touched,
  // all of the box is over the map.
  RasterMesh::Pixel center;
  if (test.IsTouched && test.IsFree && this->Mesh().Project(box.center(), center) &&
    this->Find(center) >= 0)
  {
    return BoxContent::Free;
  }
  return test.IsMatter ? BoxContent::Matter : BoxContent::Mixed;
}

}
