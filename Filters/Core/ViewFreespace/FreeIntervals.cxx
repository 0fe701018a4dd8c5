// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/FreeIntervals.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// Joins intervals that touch, up to rounding, and passes an interval on when it is complete.
class IntervalJoiner
{
public:
  explicit IntervalJoiner(const IntervalVisitor& visit)
    : Visit(visit)
  {
  }

  // Adds intervals that all begin at or after `from`, as all earlier ones began at or before it.
  // False when the visitor has seen enough.
  bool Add(double from, Intervals& more)
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

  // Passes on the last interval.
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

  const IntervalVisitor& Visit;
  bool IsOpen = false;
  std::pair<double, double> Open;
};

// Clips a range of a segment, given in raster coordinates, to the part that projects into a
// triangle and is in front of it. Homogeneous coordinates are linear along the segment, and so are
// the tests.
void ClipToTriangle(const RasterMesh& mesh, const RasterMesh::Triangle& triangle,
  const Vector3d& first, const Vector3d& last, double& begin, double& end)
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
  const Vector3d plane = mesh.PlaneOf(triangle);
  clip(1.0 - plane.dot(first), 1.0 - plane.dot(last));
  for (int i = 0; i < 3 && begin <= end; ++i)
  {
    const Vector3d line = mesh.LineThrough(triangle.corner[i], triangle.corner[(i + 1) % 3]);
    clip(line.dot(first), line.dot(last));
  }
}

// The free part of the range of a segment that lies over one cell.
void AddFreeInCell(const DisparityRaster& raster, std::size_t index, const Vector3d& first,
  const Vector3d& last, double begin, double end, Intervals& intervals)
{
  const DisparityRaster::Cell& cell = raster[index];
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
  for (const int triangle : raster.TrianglesOf(index))
  {
    double from = begin, to = end;
    ClipToTriangle(raster.Mesh(), raster.Mesh().Triangles()[triangle], first, last, from, to);
    if (from < to)
    {
      intervals.emplace_back(from, to);
    }
  }
}

// Walks along a segment over the raster, cell by cell, or tile by tile where it is far from the
// map.
class SegmentWalk
{
public:
  SegmentWalk(const DisparityRaster& raster, const Vector3d& first, const Vector3d& last)
    : Raster(raster)
    , First(first)
    , Last(last)
    , Size{ raster.Mesh().Width(), raster.Mesh().Height() }
  {
    this->ClipToRaster();
    if (this->IsOverRaster())
    {
      this->CellAt(this->Here, this->At);
      this->CellAt(this->End, this->Goal);
    }
  }

  bool IsOverRaster() const { return this->Here <= this->End && !this->Raster.IsEmpty(); }

  // Passes all free intervals to the joiner.
  void Run(IntervalJoiner& joiner);

private:
  static constexpr int TileLevel = 3; // of the pyramid
  static constexpr int TileSize = 1 << TileLevel;

  // Out of a square of cells: the place and the axis of the side crossed; -1: the segment ends in
  // it.
  struct Step
  {
    int level;
    double next;
    int axis;
  };

  void ClipToRaster();
  void CellAt(double place, int cell[2]) const;
  int CellsToGo() const
  {
    return std::abs(this->Goal[0] - this->At[0]) + std::abs(this->Goal[1] - this->At[1]);
  }
  Step StepOver(int level) const;
  bool IsDecided(const Step& step, Intervals& intervals) const;
  void Take(const Step& step);

  const DisparityRaster& Raster;
  const Vector3d First, Last; // in raster coordinates
  const int Size[2];
  double Here = 0.0, End = 1.0;
  int At[2] = { 0, 0 }, Goal[2] = { 0, 0 };
};

void SegmentWalk::Run(IntervalJoiner& joiner)
{
  Intervals intervals;
  for (bool hasMore = true; hasMore;)
  {
    const double from = this->Here;
    intervals.clear();
    Step step = this->StepOver(TileLevel);
    const bool isFar = this->CellsToGo() > TileSize;
    if (!isFar || !this->IsDecided(step, intervals))
    {
      step = this->StepOver(0);
      AddFreeInCell(this->Raster,
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

// Clips the segment to the part that is in front of the camera and over the raster.
void SegmentWalk::ClipToRaster()
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

void SegmentWalk::CellAt(double place, int cell[2]) const
{
  const Vector2d pixel = (this->First + place * (this->Last - this->First)).hnormalized();
  for (int axis = 0; axis < 2; ++axis)
  {
    cell[axis] = std::clamp(static_cast<int>(pixel[axis]), 0, this->Size[axis] - 1);
  }
}

SegmentWalk::Step SegmentWalk::StepOver(int level) const
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

// Whether the segment's part over a tile is free, or not free, as a whole.
bool SegmentWalk::IsDecided(const Step& step, Intervals& intervals) const
{
  if (this->Raster.Pyramid().size() <= TileLevel)
  {
    return false;
  }
  const DisparityRaster::Level& tiles = this->Raster.Pyramid()[TileLevel];
  const auto [low, high] =
    tiles.bounds[static_cast<std::size_t>(this->At[1] >> TileLevel) * tiles.width +
      (this->At[0] >> TileLevel)];
  const double depthBegin = this->First.z() + this->Here * (this->Last.z() - this->First.z());
  const double depthEnd = this->First.z() + step.next * (this->Last.z() - this->First.z());
  if (high * std::max(depthBegin, depthEnd) < 1.0)
  {
    intervals.emplace_back(this->Here, step.next);
    return true;
  }
  return low * std::min(depthBegin, depthEnd) > 1.0;
}

void SegmentWalk::Take(const Step& step)
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
    // The cell on the tile's side, neither back nor beyond the goal.
    int cell[2];
    this->CellAt(this->Here, cell);
    const auto [least, most] = std::minmax(this->At[other], this->Goal[other]);
    const int low = (this->At[other] >> step.level) << step.level;
    this->At[other] =
      std::clamp(cell[other], std::max(least, low), std::min(most, low + (1 << step.level) - 1));
  }
}

}

void VisitFreeIntervals(const DisparityRaster& raster, const Vector3d& first, const Vector3d& last,
  const IntervalVisitor& visit)
{
  SegmentWalk walk(raster, raster.Mesh().Raster(first), raster.Mesh().Raster(last));
  if (walk.IsOverRaster())
  {
    IntervalJoiner joiner(visit);
    walk.Run(joiner);
  }
}

}
