// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VertexSystem_h
#define freespace_VertexSystem_h

#include "Common/CancellationFlag.h"
#include "Common/GroupedLists.h"
#include "Common/ParallelFor.h"
#include "Mesh/Fit/MeshEdges.h"

#include <Eigen/SparseCore>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// The normal equations of a linear least-squares problem in the displacements of a mesh's vertices. A
/// vertex moves along one, two or three directions of its own: one where the surface is smooth, more at
/// edges and corners. Terms join the corners of a triangle or the ends of an edge only.
class VertexSystem
{
public:
  /// The directions in which a vertex moves: the first `freedom` columns.
  struct Basis
  {
    int freedom = 0;
    Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  };

  /// Keeps references to both. Each vertex is held at its position with the weight `anchor`, > 0.
  VertexSystem(const std::vector<Basis>& bases, const MeshEdges& edges, double anchor);

  /// Adds weight * (normal . (displacement of the first end - that of the second) + residual)^2.
  void AddDifference(int edge, const Eigen::Vector3d& normal, double residual, double weight);

  /// Adds weight * (normal . (displacement of the corners, mixed by weights) + residual)^2.
  void AddPlace(const std::array<std::int32_t, 3>& corners,
    const std::array<std::int32_t, 3>& edgesOfTriangle, const Eigen::Vector3d& mix,
    const Eigen::Vector3d& normal, double residual, double weight);

  /// The displacements that minimize the sum, by conjugate gradients, until the residual has fallen to this
  /// fraction of its initial value, or for this number of iterations. The same for any number of threads.
  std::vector<Eigen::Vector3d> Solve(double tolerance, int iterations,
    const ParallelFor& parallelFor, const CancellationFlag& stop = NeverCancelled);

private:
  // What a vertex is joined to.
  struct Link
  {
    std::int32_t vertex, edge;
    bool isFirst; // of the edge's ends
  };
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Links = GroupedLists<Link, std::size_t>;
  Links LinkVertices() const;
  Rows MakeRows() const;
  void InvertDiagonal(const ParallelFor& parallelFor);
  void Precondition(const Eigen::VectorXd& x, Eigen::VectorXd& result) const;

  const std::vector<Basis>& Bases;
  const MeshEdges& Edges;
  std::vector<std::int32_t> Offset;      // of each vertex' unknowns
  std::vector<Eigen::Matrix3d> Diagonal; // blocks
  std::vector<Eigen::Matrix3d> Inverse;  // of them
  std::vector<std::size_t> BlockOffset;  // of each edge's block
  std::vector<double> Blocks;            // rows: the first end's unknowns
  Eigen::VectorXd RightSide;
};

}

#endif
