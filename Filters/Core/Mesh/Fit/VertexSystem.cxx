// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/VertexSystem.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;
using Eigen::VectorXd;

VertexSystem::VertexSystem(const std::vector<Basis>& bases, const MeshEdges& edges, double anchor)
  : Bases(bases)
  , Edges(edges)
  , Offset(bases.size() + 1, 0)
  , Diagonal(bases.size(), anchor * Eigen::Matrix3d::Identity())
  , BlockOffset(edges.ends.size() + 1, 0)
{
  for (std::size_t v = 0; v < bases.size(); ++v)
  {
    this->Offset[v + 1] = this->Offset[v] + bases[v].freedom;
  }
  for (std::size_t e = 0; e < edges.ends.size(); ++e)
  {
    const auto& [a, b] = edges.ends[e];
    this->BlockOffset[e + 1] = this->BlockOffset[e] + bases[a].freedom * bases[b].freedom;
  }
  this->Blocks.assign(this->BlockOffset.back(), 0.0);
  this->RightSide = VectorXd::Zero(this->Offset.back());
}

void VertexSystem::AddDifference(int edge, const Vector3d& normal, double residual, double weight)
{
  const auto& ends = this->Edges.ends[edge];
  Vector3d along[2];
  for (int i = 0; i < 2; ++i)
  {
    along[i] = (i == 0 ? 1.0 : -1.0) * (this->Bases[ends[i]].directions.transpose() * normal);
    this->Diagonal[ends[i]] += weight * along[i] * along[i].transpose();
    const int freedom = this->Bases[ends[i]].freedom;
    this->RightSide.segment(this->Offset[ends[i]], freedom) -=
      weight * residual * along[i].head(freedom);
  }
  double* block = &this->Blocks[this->BlockOffset[edge]];
  for (int i = 0; i < this->Bases[ends[0]].freedom; ++i)
  {
    for (int j = 0; j < this->Bases[ends[1]].freedom; ++j)
    {
      *block++ += weight * along[0][i] * along[1][j];
    }
  }
}

void VertexSystem::AddPlace(const std::array<std::int32_t, 3>& corners,
  const std::array<std::int32_t, 3>& edgesOfTriangle, const Vector3d& mix, const Vector3d& normal,
  double residual, double weight)
{
  Vector3d along[3];
  for (int i = 0; i < 3; ++i)
  {
    const Basis& basis = this->Bases[corners[i]];
    along[i] = mix[i] * (basis.directions.transpose() * normal);
    this->Diagonal[corners[i]] += weight * along[i] * along[i].transpose();
    this->RightSide.segment(this->Offset[corners[i]], basis.freedom) -=
      weight * residual * along[i].head(basis.freedom);
  }
  for (int side = 0; side < 3; ++side)
  {
    int a = side, b = (side + 1) % 3;
    if (corners[a] > corners[b])
    {
      std::swap(a, b);
    }
    double* block = &this->Blocks[this->BlockOffset[edgesOfTriangle[side]]];
    for (int i = 0; i < this->Bases[corners[a]].freedom; ++i)
    {
      for (int j = 0; j < this->Bases[corners[b]].freedom; ++j)
      {
        *block++ += weight * along[a][i] * along[b][j];
      }
    }
  }
}

// The neighbours of each vertex.
VertexSystem::Links VertexSystem::LinkVertices() const
{
  return Links(this->Bases.size(),
    [this](const auto& add)
    {
      for (std::size_t e = 0; e < this->Edges.ends.size(); ++e)
      {
        const auto& [a, b] = this->Edges.ends[e];
        const auto edge = static_cast<std::int32_t>(e);
        add(a, { b, edge, true });
        add(b, { a, edge, false });
      }
    });
}

VertexSystem::Rows VertexSystem::MakeRows() const
{
  const Links links = this->LinkVertices();
  const int size = this->Offset.back();
  Rows rows(size, size);
  std::size_t entries = 2 * this->Blocks.size();
  for (const Basis& basis : this->Bases)
  {
    entries += basis.freedom * basis.freedom;
  }
  rows.reserve(static_cast<Eigen::Index>(entries));
  for (std::size_t v = 0; v < this->Bases.size(); ++v)
  {
    const int height = this->Bases[v].freedom;
    for (int i = 0; i < height; ++i)
    {
      const int row = this->Offset[v] + i;
      rows.startVec(row);
      for (int j = 0; j < height; ++j)
      {
        rows.insertBackByOuterInnerUnordered(row, this->Offset[v] + j) = this->Diagonal[v](i, j);
      }
      for (const Link& link : links[v])
      {
        const int width = this->Bases[link.vertex].freedom;
        const double* block = this->Blocks.data() + this->BlockOffset[link.edge];
        for (int j = 0; j < width; ++j)
        {
          rows.insertBackByOuterInnerUnordered(row, this->Offset[link.vertex] + j) =
            block[link.isFirst ? i * width + j : j * height + i];
        }
      }
    }
  }
  rows.finalize();
  return rows;
}

void VertexSystem::InvertDiagonal(const ParallelFor& parallelFor)
{
  this->Inverse.resize(this->Diagonal.size());
  parallelFor(this->Inverse.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t v = begin; v < end; ++v)
      {
        this->Inverse[v] = this->Diagonal[v].inverse();
      }
    });
}

void VertexSystem::Precondition(const VectorXd& from, VectorXd& to) const
{
  for (std::size_t v = 0; v < this->Inverse.size(); ++v)
  {
    const int size = this->Bases[v].freedom, at = this->Offset[v];
    if (size == 1)
    {
      to[at] = this->Inverse[v](0, 0) * from[at];
      continue;
    }
    for (int i = 0; i < size; ++i)
    {
      double sum = 0;
      for (int j = 0; j < size; ++j)
      {
        sum += this->Inverse[v](i, j) * from[at + j];
      }
      to[at + i] = sum;
    }
  }
}

std::vector<Vector3d> VertexSystem::Solve(
  double tolerance, int iterations, const ParallelFor& parallelFor, const CancellationFlag& stop)
{
  this->InvertDiagonal(parallelFor);
  const Rows rows = this->MakeRows();
  VectorXd x = VectorXd::Zero(rows.rows()), r = this->RightSide, z(rows.rows()), p, q(rows.rows());
  this->Precondition(r, z);
  p = z;
  double rz = r.dot(z);
  const double enough = tolerance * tolerance * rz;
  for (int i = 0; i < iterations && rz > enough; ++i)
  {
    ThrowIfCancelled(stop);
    parallelFor(static_cast<std::size_t>(rows.rows()),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t row = begin; row < end; ++row)
        {
          double sum = 0;
          for (int k = rows.outerIndexPtr()[row]; k < rows.outerIndexPtr()[row + 1]; ++k)
          {
            sum += rows.valuePtr()[k] * p[rows.innerIndexPtr()[k]];
          }
          q[static_cast<Eigen::Index>(row)] = sum;
        }
      });
    const double step = rz / p.dot(q);
    x += step * p;
    r -= step * q;
    this->Precondition(r, z);
    const double before = rz;
    rz = r.dot(z);
    p = z + (rz / before) * p;
  }
  std::vector<Vector3d> displacements(this->Bases.size());
  for (std::size_t v = 0; v < displacements.size(); ++v)
  {
    const int freedom = this->Bases[v].freedom;
    displacements[v] =
      this->Bases[v].directions.leftCols(freedom) * x.segment(this->Offset[v], freedom);
  }
  return displacements;
}

}
