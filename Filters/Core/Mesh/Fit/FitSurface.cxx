// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/FitSurface.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Common/ParallelForWithProgress.h"
#include "Mesh/Fit/TriangleGrid.h"
#include "Mesh/Fit/Untangle.h"
#include "Mesh/Fit/VertexSystem.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

// Lower bound of the cosine of incidence in the deviation of a feature.
constexpr double LeastSightCosine = 0.15;

// Bounds of the deviations of features, in units of the typical one.
constexpr double LeastDeviation = 0.2;
constexpr double MostDeviation = 10;

// Of the deviation of features in units of their median distance.
constexpr double DeviationOfMedian = 1.5;

// Normals around a vertex that differ by more than this share of them give it another freedom: two
// planes do that turn by 26 degrees.
constexpr double LeastEigenvalue = 0.05;

// Standard deviation of the prior that holds a vertex at its position, in median edges.
constexpr double AnchorEdges = 1.0;

constexpr double SolverTolerance = 1e-2;
constexpr int SolverIterations = 50;

// Where a feature meets the surface.
struct Contact
{
  TrianglePlace place;
  double deviation = 0; // across the surface, in units of the features' common one
  double distance = 0;  // above the surface
};

class SurfaceFitter
{
public:
  SurfaceFitter(std::vector<Vector3d>& points, const Triangles& triangles,
    const std::vector<SeenFeature>& features, const FitSurfaceOptions& options,
    const ParallelFor& parallelFor)
    : Points(points)
    , Corners(triangles)
    , Features(features)
    , Options(options)
    , Parallel(parallelFor)
    , Edges(triangles, points.size())
    , Original(points)
    , MedianEdge(this->FindMedianEdge())
    , TypicalDeviation(this->FindTypicalDeviation())
  {
  }

  void Round(const CancellationFlag& stop);
  double TypicalEdge() const { return this->MedianEdge; }

private:
  double FindMedianEdge() const;
  double FindTypicalDeviation() const;
  double RelativeDeviation(const SeenFeature& feature) const;
  void FindContacts(const CancellationFlag& stop);
  double CommonDeviation() const;
  std::vector<VertexSystem::Basis> FindBases() const;
  void AddNormals(VertexSystem& system) const;
  void AddFeatures(VertexSystem& system) const;

  std::vector<Vector3d>& Points;
  const Triangles& Corners;
  const std::vector<SeenFeature>& Features;
  const FitSurfaceOptions& Options;
  const ParallelFor& Parallel;
  const MeshEdges Edges;
  const std::vector<Vector3d> Original;
  const double MedianEdge;
  const double TypicalDeviation; // of the features, as a fraction of the depth; 0: none is known
  std::vector<Vector3d> Normals; // smoothed
  std::vector<double> Areas;
  std::vector<Contact> Contacts;
};

double SurfaceFitter::FindMedianEdge() const
{
  std::vector<double> lengths;
  lengths.reserve(this->Edges.ends.size());
  for (const auto& [a, b] : this->Edges.ends)
  {
    lengths.push_back((this->Points[a] - this->Points[b]).norm());
  }
  return MedianOr(std::move(lengths), 0.0);
}

double SurfaceFitter::FindTypicalDeviation() const
{
  std::vector<double> known;
  for (const SeenFeature& feature : this->Features)
  {
    if (feature.deviation > 0)
    {
      known.push_back(feature.deviation);
    }
  }
  return MedianOr(std::move(known), 0.0);
}

// In units of the typical one, which is assumed for a feature of unknown deviation.
double SurfaceFitter::RelativeDeviation(const SeenFeature& feature) const
{
  return feature.deviation > 0
    ? std::clamp(feature.deviation / this->TypicalDeviation, LeastDeviation, MostDeviation)
    : 1;
}

void SurfaceFitter::FindContacts(const CancellationFlag& stop)
{
  const TriangleGrid grid(this->Points, this->Corners, 2 * this->MedianEdge);
  this->Contacts.resize(this->Features.size());
  this->Parallel(this->Features.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end && !stop; ++f)
      {
        const SeenFeature& feature = this->Features[f];
        const double depth = feature.sight.norm();
        Contact& contact = this->Contacts[f];
        contact.place = grid.Nearest(feature.point, feature.sight, this->Options.reach * depth,
          contact.place.triangle); // of the last round
        if (contact.place.triangle < 0)
        {
          continue;
        }
        const Vector3d& normal = this->Normals[contact.place.triangle];
        const auto& [a, b, c] = this->Corners[contact.place.triangle];
        const Vector3d& weights = contact.place.weights;
        contact.distance = normal.dot(feature.point - weights[0] * this->Points[a] -
          weights[1] * this->Points[b] - weights[2] * this->Points[c]);
        contact.deviation = this->RelativeDeviation(feature) *
          std::max(std::abs(normal.dot(feature.sight)), LeastSightCosine * depth);
      }
    });
  ThrowIfCancelled(stop);
}

// Of all features, as a fraction of their depth.
double SurfaceFitter::CommonDeviation() const
{
  std::vector<double> ratios;
  for (const Contact& contact : this->Contacts)
  {
    if (contact.place.triangle >= 0)
    {
      ratios.push_back(std::abs(contact.distance) / contact.deviation);
    }
  }
  if (ratios.empty())
  {
    return 1;
  }
  constexpr double least = 1e-5;
  return std::max(least, DeviationOfMedian * Median(std::move(ratios)));
}

// The directions that the normals around each vertex span.
std::vector<VertexSystem::Basis> SurfaceFitter::FindBases() const
{
  std::vector<Eigen::Matrix3d> spread(this->Points.size(), Eigen::Matrix3d::Zero());
  for (std::size_t t = 0; t < this->Corners.size(); ++t)
  {
    const Eigen::Matrix3d share = this->Areas[t] * this->Normals[t] * this->Normals[t].transpose();
    for (const int corner : this->Corners[t])
    {
      spread[corner] += share;
    }
  }
  std::vector<VertexSystem::Basis> bases(spread.size());
  this->Parallel(spread.size(),
    [&](std::size_t begin, std::size_t end)
    {
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
      for (std::size_t v = begin; v < end; ++v)
      {
        const double sum = spread[v].trace();
        if (!(sum > 0))
        {
          continue;
        }
        solver.computeDirect(spread[v] / sum);
        VertexSystem::Basis& basis = bases[v];
        for (int i = 2; i >= 0; --i)
        {
          if (i == 2 || solver.eigenvalues()[i] > LeastEigenvalue)
          {
            basis.directions.col(basis.freedom++) = solver.eigenvectors().col(i);
          }
        }
      }
    });
  return bases;
}

void SurfaceFitter::AddNormals(VertexSystem& system) const
{
  // Small triangles have little weight, very short edges none.
  const double shortest = 0.3 * this->MedianEdge;
  const double typicalArea = 0.4 * this->MedianEdge * this->MedianEdge;
  for (std::size_t t = 0; t < this->Corners.size(); ++t)
  {
    const double share = std::min(2.0, this->Areas[t] / typicalArea) / 3;
    for (const int edge : this->Edges.ofTriangle[t])
    {
      const auto& [a, b] = this->Edges.ends[edge];
      const Vector3d along = this->Points[a] - this->Points[b];
      const double deviation = this->Options.waviness * std::max(shortest, along.norm());
      system.AddDifference(
        edge, this->Normals[t], this->Normals[t].dot(along), share / (deviation * deviation));
    }
  }
}

void SurfaceFitter::AddFeatures(VertexSystem& system) const
{
  const double common = this->CommonDeviation();
  for (const Contact& contact : this->Contacts)
  {
    const int t = contact.place.triangle;
    if (t >= 0)
    {
      const double deviation = common * contact.deviation;
      const double outlying = contact.distance / (2 * deviation);
      const double robust = 1 / (1 + outlying * outlying);
      system.AddPlace(this->Corners[t], this->Edges.ofTriangle[t], contact.place.weights,
        this->Normals[t], -contact.distance, robust * robust / (deviation * deviation));
    }
  }
}

void SurfaceFitter::Round(const CancellationFlag& stop)
{
  TriangleNormals(this->Points, this->Corners, this->Normals, this->Areas, this->Parallel);
  const double leastArea = 1e-3 * this->MedianEdge * this->MedianEdge;
  for (double& area : this->Areas)
  {
    area = std::max(area, leastArea);
  }
  FilterNormals(this->Normals, this->Areas, this->Edges, this->Options.normals, this->Parallel);
  ThrowIfCancelled(stop);
  this->FindContacts(stop);
  const std::vector<VertexSystem::Basis> bases = this->FindBases();
  const double anchor = 1 / (AnchorEdges * this->MedianEdge);
  VertexSystem system(bases, this->Edges, anchor * anchor);
  this->AddNormals(system);
  this->AddFeatures(system);
  const std::vector<Vector3d> moves =
    system.Solve(SolverTolerance, SolverIterations, this->Parallel, stop);
  const double most = this->Options.mostMove * this->MedianEdge;
  for (std::size_t v = 0; v < moves.size(); ++v)
  {
    const Vector3d moved = this->Points[v] + moves[v] - this->Original[v];
    const double length = moved.norm();
    this->Points[v] = this->Original[v] + (length > most ? most / length : 1.0) * moved;
  }
}

}

void FitSurfaceOptions::Check() const
{
  if (this->rounds < 0)
  {
    throw Error("The rounds of a fit must not be negative.");
  }
  this->normals.Check();
  for (const double positive : { this->waviness, this->reach, this->mostMove })
  {
    if (!(positive > 0) || !std::isfinite(positive))
    {
      throw Error("The waviness, the reach and the greatest move of a fit must be positive.");
    }
  }
}

void FitSurface(std::vector<Vector3d>& points, const Triangles& triangles,
  const std::vector<SeenFeature>& features, const FitSurfaceOptions& options,
  const Progress& progress, const ParallelFor& parallelFor)
{
  options.Check();
  progress(0.0);
  if (triangles.empty() || options.rounds == 0)
  {
    progress(1.0);
    return;
  }
  const std::vector<Vector3d> original = points;
  constexpr double fitted = 0.8;
  SurfaceFitter fitter(points, triangles, features, options, parallelFor);
  for (int round = 0; round < options.rounds; ++round)
  {
    RunWithProgress(
      progress.Part(fitted * round / options.rounds, fitted * (round + 1) / options.rounds),
      [&](const CancellationFlag& stop) { fitter.Round(stop); });
  }
  UntangleOptions untangle;
  untangle.isSingle = options.isSingle;
  untangle.cell = 2 * fitter.TypicalEdge();
  Untangle(points, original, triangles, untangle, progress.Part(fitted, 1.0), parallelFor);
}

}
