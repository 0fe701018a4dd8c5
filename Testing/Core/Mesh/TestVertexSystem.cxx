// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/VertexSystem.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

using namespace freespace;
using Eigen::Vector3d;

TEST(VertexSystem, SolvesAsDenseLeastSquaresDo)
{
  const std::vector<std::array<std::int32_t, 3>> triangles = { { 0, 1, 2 }, { 2, 1, 3 } };
  const MeshEdges edges(triangles, 4);
  ASSERT_EQ(edges.ends.size(), 5u);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<VertexSystem::Basis> bases(4);
  std::vector<int> offset = { 0 };
  for (int v = 0; v < 4; ++v)
  {
    bases[v].freedom = 1 + v % 3;
    const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
    const Eigen::Matrix3d q = Eigen::HouseholderQR<Eigen::Matrix3d>(any).householderQ();
    bases[v].directions.leftCols(bases[v].freedom) = q.leftCols(bases[v].freedom);
    offset.push_back(offset.back() + bases[v].freedom);
  }
  constexpr double anchor = 0.1;
  VertexSystem system(bases, edges, anchor);
  const int size = offset.back();
  Eigen::MatrixXd H = anchor * Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  const auto add = [&](const std::vector<std::pair<int, double>>& mix, const Vector3d& normal,
                     double residual, double weight)
  {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
    for (const auto& [v, share] : mix)
    {
      for (int k = 0; k < bases[v].freedom; ++k)
      {
        row[offset[v] + k] += share * bases[v].directions.col(k).dot(normal);
      }
    }
    H += weight * row * row.transpose();
    g -= weight * residual * row;
  };
  for (int e = 0; e < 5; ++e)
  {
    const Vector3d normal(number(random), number(random), number(random));
    const double residual = number(random), weight = 1 + number(random);
    system.AddDifference(e, normal, residual, weight);
    add({ { edges.ends[e][0], 1 }, { edges.ends[e][1], -1 } }, normal, residual, weight);
  }
  for (int t = 0; t < 2; ++t)
  {
    const Vector3d normal(number(random), number(random), number(random)), mix(0.2, 0.5, 0.3);
    const double residual = number(random), weight = 1 + number(random);
    system.AddPlace(triangles[t], edges.ofTriangle[t], mix, normal, residual, weight);
    add({ { triangles[t][0], 0.2 }, { triangles[t][1], 0.5 }, { triangles[t][2], 0.3 } }, normal,
      residual, weight);
  }
  const Eigen::VectorXd expected = H.ldlt().solve(g);
  const std::vector<Vector3d> moves = system.Solve(1e-12, 100, SerialFor);
  for (int v = 0; v < 4; ++v)
  {
    Vector3d move = Vector3d::Zero();
    for (int k = 0; k < bases[v].freedom; ++k)
    {
      move += expected[offset[v] + k] * bases[v].directions.col(k);
    }
    EXPECT_LT((moves[v] - move).norm(), 1e-9);
  }
}
