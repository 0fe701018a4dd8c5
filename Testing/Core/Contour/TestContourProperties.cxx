// SPDX-License-Identifier: BSD-3-Clause

// What a contour promises, tried on a hundred random unions: closed, 2-manifold, oriented, without
// self-intersection, without triangles that vanish, also in single precision; and with the volume and
// the area that a dense evaluation of the function finds.

#include "Contour/Lattice/ContourBlock.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/PlainSettings.h"
#include "Support/MeshTopology.h"
#include "Support/RandomMaps.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

bool MeetsItself(const ContourMesh& mesh)
{
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  // Rounded in memory: GCC 12 leaves out a conversion to single precision and back.
  std::vector<Eigen::Vector3f> rounded;
  for (const Vector3d& p : mesh.points)
  {
    rounded.push_back(p.cast<float>());
  }
  for (const Eigen::Vector3f& f : rounded)
  {
    surface.add_vertex(Kernel::Point_3(f.x(), f.y(), f.z()));
  }
  for (const auto& t : mesh.triangles)
  {
    using Vertex = CGAL::SM_Vertex_index;
    surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
  }
  return CGAL::Polygon_mesh_processing::does_self_intersect(surface);
}

// The volume, and the area that the surface shows along each axis (both sides counted).
struct Extent
{
  double volume = 0.0;
  Vector3d shown = Vector3d::Zero();
  Vector3d thin = Vector3d::Zero(); ///< of matter that holds one point of a line
};

Extent Measure(const ContourMesh& mesh)
{
  Extent extent;
  extent.volume = EnclosedVolume(mesh);
  for (const auto& t : mesh.triangles)
  {
    const Vector3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    extent.shown += 0.5 * (b - a).cross(c - a).cwiseAbs();
  }
  return extent;
}

// The same by counting: matter points, and changes of the sign along the lines of a lattice. It is as
// fine as the contour's, so that both miss the same slivers, but shifted, in cells.
Extent MeasureDensely(const FreespaceUnion& phi, int cells, const Vector3d& shift)
{
  const Eigen::AlignedBox3d& box = phi.Hull().Bounds();
  const double step = box.sizes().maxCoeff() / (cells - 1);
  const Vector3d first = ContourLattice(box, cells).origin + step * shift;
  const LatticeIndex size = { static_cast<int>(box.sizes().x() / step) + 3,
    static_cast<int>(box.sizes().y() / step) + 3, static_cast<int>(box.sizes().z() / step) + 3 };
  std::vector<char> matter(size[0] * size[1] * size[2]);
  const auto at = [&](int i, int j, int k) -> char&
  { return matter[(k * size[1] + j) * size[0] + i]; };
  Extent extent;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const char here = at(i, j, k) = phi.Value(first + step * Vector3d(i, j, k)) <= 0;
        extent.volume += here * step * step * step;
        extent.shown += step * step *
          Vector3d(i > 0 && here != at(i - 1, j, k), j > 0 && here != at(i, j - 1, k),
            k > 0 && here != at(i, j, k - 1));
        const auto isThin = [here](char before, char beforeThat)
        { return !here && before && !beforeThat; };
        extent.thin += 2 * step * step *
          Vector3d(i > 1 && isThin(at(i - 1, j, k), at(i - 2, j, k)),
            j > 1 && isThin(at(i, j - 1, k), at(i, j - 2, k)),
            k > 1 && isThin(at(i, j, k - 1), at(i, j, k - 2)));
      }
    }
  }
  return extent;
}

class RandomUnion : public testing::TestWithParam<unsigned int>
{
};

}

TEST_P(RandomUnion, ContourKeepsItsPromises)
{
  const unsigned int seed = GetParam();
  auto unionOptions = Plain(FreespaceUnionOptions());
  unionOptions.minimumViews = 1 + seed % 3 / 2;
  // A margin of some cells, or none: then there is matter of all thicknesses down to nothing.
  unionOptions.hullMargin = seed % 7 == 0 ? 0.0 : 0.05;
  const FreespaceUnion phi(RandomMaps(1000 + seed, 1 + seed % 6), unionOptions);
  ContourOptions options;
  options.cells = 36;
  options.sharp = false;
  options.exact = seed % 2 == 0;
  const ContourMesh mesh = BisectionContour(phi, phi.Hull().Bounds(), options);
  ASSERT_GT(mesh.triangles.size(), 100u);
  EXPECT_EQ(TopologyFaults(mesh), "");
  EXPECT_FALSE(MeetsItself(mesh));
  options.sharp = true;
  const ContourMesh sharp = BisectionContour(phi, phi.Hull().Bounds(), options);
  EXPECT_GT(sharp.points.size(), mesh.points.size());
  EXPECT_EQ(TopologyFaults(sharp), "");
  EXPECT_FALSE(MeetsItself(sharp));
  // The volume by points that the contour did not ask for; the area by its own lines. Of matter that
  // holds one point of a line the contour shows anything from nothing to what is counted.
  const Extent other = MeasureDensely(phi, options.cells, Vector3d(0.2, 0.1, 0.3));
  const Extent dense = MeasureDensely(phi, options.cells, Vector3d::Zero());
  const double hull = phi.Hull().Bounds().volume();
  for (const ContourMesh* either : { &mesh, &sharp })
  {
    const Extent measured = Measure(*either);
    EXPECT_NEAR(measured.volume, other.volume, 0.01 * hull);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double sum = dense.shown.sum(), thin = std::min(dense.thin[axis], 0.07 * sum);
      EXPECT_NEAR(measured.shown[axis], dense.shown[axis], 0.01 * sum + thin);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Contour, RandomUnion, testing::Range(0u, 100u));

TEST(ContourOfNoise, NeverMeetsItself)
{
  // Matter or free by a coin for each lattice point, vertices anywhere.
  class Noise : public ContourField
  {
  public:
    bool IsFree(const Vector3d& point, const FieldScope&) const override
    {
      const auto cell = [](double x) { return std::llround(x * 29) + 100; };
      std::mt19937 random(static_cast<unsigned int>(
        cell(point.x()) + 1000 * cell(point.y()) + 1000000 * cell(point.z())));
      return random() & 1;
    }
  };
  const Eigen::AlignedBox3d bounds(Vector3d(0.1, 0.15, 0.12), Vector3d(1, 1, 1));
  for (int cells : { 23, 26, 31 })
  {
    ContourOptions options;
    options.cells = cells;
    options.sharp = false;
    const ContourMesh mesh = BisectionContour(Noise(), bounds, options);
    ASSERT_GT(mesh.triangles.size(), 10000u);
    EXPECT_EQ(TopologyFaults(mesh), "");
    EXPECT_FALSE(MeetsItself(mesh));
    // Without normals there are no sharp edges, but matter hangs together across many faces.
    options.sharp = true;
    const ContourMesh joined = BisectionContour(Noise(), bounds, options);
    EXPECT_NE(joined.triangles, mesh.triangles);
    EXPECT_EQ(TopologyFaults(joined), "");
    EXPECT_FALSE(MeetsItself(joined));
  }
}
