// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FeatureHull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// Outside of the hull: some plane through three points has all points on one side, and this beyond.
double BruteForceHull(const std::vector<Vector3d>& points, const Vector3d& x)
{
  double greatest = -HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = i + 1; j < points.size(); ++j)
    {
      for (std::size_t k = j + 1; k < points.size(); ++k)
      {
        Vector3d n = (points[j] - points[i]).cross(points[k] - points[i]).normalized();
        double low = 0, high = 0;
        for (const Vector3d& p : points)
        {
          low = std::min(low, n.dot(p - points[i]));
          high = std::max(high, n.dot(p - points[i]));
        }
        if (low > -1e-12 || high < 1e-12)
        {
          n = high > 1e-12 ? Vector3d(-n) : n;
          greatest = std::max(greatest, n.dot(x - points[i]));
        }
      }
    }
  }
  return greatest;
}

}

TEST(FeatureHull, AgreesWithBruteForce)
{
  for (int seed = 0; seed < 10; ++seed)
  {
    std::srand(seed);
    std::vector<Vector3d> points(14);
    std::generate(points.begin(), points.end(), [] { return Vector3d::Random(); });
    const FeatureHull hull(points, 0.0);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3d x = 1.2 * Vector3d::Random();
      const double truth = BruteForceHull(points, x);
      const double value = hull.Distance(hull.NearestPlane(x), x);
      if (truth < 0)
      {
        EXPECT_NEAR(value, truth, 1e-9);
      }
      else
      {
        EXPECT_GE(value, truth - 1e-9);
      }
    }
  }
}

TEST(FeatureHull, LeavingOutInnerPointsChangesNothing)
{
  std::srand(3);
  std::vector<Vector3d> points(5000);
  std::generate(points.begin(), points.end(), [] { return Vector3d::Random(); });
  const FeatureHull hull(points, 0.0);
  double touched = -1;
  for (const Vector3d& p : points)
  {
    const double distance = hull.Distance(hull.NearestPlane(p), p);
    EXPECT_LE(distance, 1e-12);
    touched = std::max(touched, distance);
  }
  for (int plane = 0; plane < hull.NumberOfPlanes(); ++plane)
  {
    double nearest = -1;
    for (const Vector3d& p : points)
    {
      nearest = std::max(nearest, hull.Distance(plane, p));
    }
    EXPECT_NEAR(nearest, 0.0, 1e-12);
  }
  EXPECT_NEAR(touched, 0.0, 1e-12);
}

TEST(FeatureHull, TheNearestPlaneIsTheNearestOfAll)
{
  std::srand(4);
  std::vector<Vector3d> points(3000);
  for (Vector3d& p : points)
  {
    // A box with noise, as of a board: facets by the hundred, nearly parallel.
    p = Vector3d::Random();
    p[std::rand() % 3] = (std::rand() % 2 ? 1.0 : -1.0) + 1e-3 * Vector3d::Random().x();
  }
  const FeatureHull hull(points, 0.02);
  EXPECT_GT(hull.NumberOfPlanes(), 100);
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3d x = (i % 2 ? 1.03 : 1.5) * Vector3d::Random();
    EXPECT_NEAR(
      hull.Distance(hull.NearestPlane(x), x), hull.Distance(hull.NearestOfAll(x), x), 1e-9);
  }
}

TEST(FeatureHull, WithoutVolumeTheMarginGivesOne)
{
  const Vector3d o(1, 2, 3), u(1, 0.5, 0), v(0, 1, 1);
  for (const std::vector<Vector3d>& points :
    { std::vector<Vector3d>{ o }, std::vector<Vector3d>{ o, o + u },
      std::vector<Vector3d>{ o, o + u, o + 2 * u }, std::vector<Vector3d>{ o, o + u, o + v },
      std::vector<Vector3d>{ o, o + u, o + v, o + u + v },
      std::vector<Vector3d>{ o, o, o, Vector3d(NAN, 0, 0) } })
  {
    const FeatureHull thick(points, 0.1), thin(points, 0.0);
    for (const Vector3d& p : points)
    {
      if (p.allFinite())
      {
        EXPECT_NEAR(thick.Distance(thick.NearestPlane(p), p), -0.1, 1e-9);
        EXPECT_NEAR(thin.Distance(thin.NearestPlane(p), p), 0.0, 1e-9);
      }
    }
    const Vector3d away = thick.Bounds().max() + Vector3d::Constant(1e-6);
    EXPECT_GT(thick.Distance(thick.NearestPlane(away), away), 0);
    EXPECT_LT(thick.Bounds().diagonal().norm(), 5);
  }
  EXPECT_TRUE(FeatureHull({}, 0.1).IsEmpty());
  EXPECT_TRUE(FeatureHull({ Vector3d(NAN, 0, 0) }, 0.1).IsEmpty());
}
