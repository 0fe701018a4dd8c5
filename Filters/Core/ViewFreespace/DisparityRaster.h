// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityRaster_h
#define freespace_DisparityRaster_h

#include "Common/BoxContent.h"
#include "Common/GroupedLists.h"
#include "ViewFreespace/RasterMesh.h"

#include <utility>

namespace freespace
{

/// A raster over the triangles of a disparity map. Each cell keeps the triangles that touch it and
/// bounds of their disparities; a pyramid keeps the bounds of larger squares of cells.
///
/// The triangle at a pixel is found in constant time: from one triangle of its cell by a walk of
/// bounded length. The bounds decide most points before any triangle is looked at, and classify
/// whole boxes.
class DisparityRaster
{
public:
  struct Cell
  {
    float low;  ///< lower bound of the disparities in the cell; infinite where there is no triangle
    float high; ///< upper bound; infinite where the cell is not wholly covered
    int triangle; ///< one that touches the cell, or -1
  };

  /// A level of the pyramid: the bounds, low and high, of squares of 2^level cells.
  struct Level
  {
    int width, height;
    std::vector<std::pair<float, float>> bounds;
  };

  /// Throws Aborted soon after the flag is set.
  DisparityRaster(const DisparityMap& map, const CancellationFlag& stop);

  const RasterMesh& Mesh() const { return this->TriangleMesh; }
  bool IsEmpty() const { return this->TriangleMesh.Triangles().empty(); }

  /// The index of the cell of a pixel on the raster.
  std::size_t CellAt(double x, double y) const
  {
    return static_cast<std::size_t>(static_cast<int>(y)) * this->TriangleMesh.Width() +
      static_cast<int>(x);
  }
  const Cell& operator[](std::size_t cell) const { return this->Cells[cell]; }

  /// All triangles that touch a cell.
  GroupedLists<int>::Range TrianglesOf(std::size_t cell) const { return this->Lists[cell]; }

  /// Level 0 is the raster.
  const std::vector<Level>& Pyramid() const { return this->Levels; }

  /// The triangle at a pixel on the raster, or -1.
  int Find(const RasterMesh::Pixel& pixel) const;

  /// Free: all of the box is in front of the triangles; Matter: no point of it is. Conservative.
  BoxContent Classify(const Eigen::AlignedBox3d& box) const;

  /// The same for boxes that span no more than a few cells of the raster, from the triangles
  /// themselves: it tends to the exact answer as the box shrinks. Mixed for larger boxes.
  BoxContent ClassifyFinely(const Eigen::AlignedBox3d& box) const;

  /// Whether some point of the box may project onto the raster. Conservative.
  bool MayCover(const Eigen::AlignedBox3d& box) const
  {
    return !this->IsEmpty() && !this->FootprintOf(box).isBehind;
  }

private:
  /// The cells that the image of a box touches.
  struct Footprint
  {
    bool isBehind;            ///< the box is behind the camera, or beside the raster
    bool isAround;            ///< the box is too close to the camera to decide
    bool isWithin;            ///< all of the image is on the raster
    double nearest, furthest; ///< depths
    int low[2], high[2];
  };
  /// Consecutive cells of a row that a triangle touches.
  struct Run
  {
    int cell, count, triangle;
  };
  class BoxTest;

  void FillCells(const CancellationFlag& stop);
  void Rasterize(int t, std::vector<Run>& runs);
  void UnboundBorder();
  void MakePyramid();
  int LocateInCell(double x, double y) const;
  Footprint FootprintOf(const Eigen::AlignedBox3d& box) const;

  RasterMesh TriangleMesh;
  std::vector<Cell> Cells;
  GroupedLists<int> Lists; ///< of the triangles that touch each cell
  std::vector<Level> Levels;
};

}

#endif
