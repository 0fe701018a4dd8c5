// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangleTree_h
#define freespace_TriangleTree_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace freespace
{

/// The place of a surface that is nearest to a point.
struct NearestPlace
{
  double distance = std::numeric_limits<double>::infinity();
  int triangle = -1; ///< of the mesh; -1: none within reach
};

/// The triangles of a mesh in a balanced tree of boxes, to find the nearest one to a point. CGAL's
/// AABB_tree finds the same distances; this one is built on all threads, takes triangles without area, and starts
/// the search for each of many points from where the last one was found (BenchmarkSurfaceComparison
/// measures both). Triangles with a corner that is not finite are left out.
class TriangleTree
{
public:
  /// O(n log n).
  explicit TriangleTree(const TriangleMesh& mesh, const ParallelFor& parallelFor = SerialFor);

  bool IsEmpty() const { return this->Indices.empty(); }

  /// The nearest triangle no farther than the reach, for each of the points; none for a point that is not finite.
  /// Exact but for rounding: of triangles at the same distance it may be any, the same for any number
  /// of threads. Fast where points that follow each other are near to each other.
  std::vector<NearestPlace> Find(const std::vector<Eigen::Vector3d>& points,
    double reach = std::numeric_limits<double>::infinity(),
    const ParallelFor& parallelFor = SerialFor, const Progress& progress = {}) const;

private:
  /// The boxes of a node's four children, about Origin, a little too large for what single precision loses.
  struct Node
  {
    std::array<Eigen::Array4f, 3> low, high; // by axis
  };

  struct Corners
  {
    Eigen::Vector3d a, b, c;
  };

  /// The best triangle so far, by its place in Triangles.
  struct Best
  {
    double squared;
    std::int64_t place = -1;
  };

  std::size_t FirstOf(int level, std::size_t node) const;
  void Sort(const TriangleMesh& mesh, const ParallelFor& parallelFor);
  void MakeBoxes(const ParallelFor& parallelFor);
  void SetBox(std::size_t node, int level, std::size_t numberInLevel, int child);
  void Look(std::size_t place, const Eigen::Vector3d& point, Best& best) const;
  void Search(const Eigen::Vector3d& point, Best& best) const;

  // A complete tree: the children of node i are 4 i + 1 to 4 i + 4. Below the last level there are leaves, whose
  // triangles begin at Firsts. All are in the order of a space-filling curve.
  int Depth = 1; ///< levels of Nodes
  std::vector<Node> Nodes;
  std::vector<std::uint32_t> Firsts; ///< in Triangles, of each leaf, and the end
  std::vector<Corners> Triangles;
  std::vector<int> Indices; ///< in the mesh
  Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
  float Margin = 0; ///< of boxes
};

}

#endif
