// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/BoundedField.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// Matter is x < height; knows boxes and crossings.
class HalfSpace : public ContourField
{
public:
  explicit HalfSpace(double height)
    : Height(height)
  {
  }
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    return point.x() >= this->Height;
  }
  BoxContent Classify(const AlignedBox3d& box, const FieldScope&, FieldScope&) const override
  {
    return box.min().x() >= this->Height ? BoxContent::Free
      : box.max().x() < this->Height     ? BoxContent::Matter
                                         : BoxContent::Mixed;
  }
  bool Crossing(const Vector3d& matter, const Vector3d& free, const FieldScope&, double& place,
    SurfaceLabel& label) const override
  {
    place = (this->Height - matter.x()) / (free.x() - matter.x());
    label = { 5, SurfaceKind::Feature, Vector3d::UnitX() };
    return true;
  }
  SurfaceLabel Label(const Vector3d&, const Vector3d&, const FieldScope&) const override
  {
    return { 5, SurfaceKind::Feature, Vector3d::UnitX() };
  }

private:
  double Height;
};

const AlignedBox3d UnitBounds(Vector3d::Zero(), Vector3d::Ones());

AlignedBox3d FlatBoxAt(double x, double y, double side)
{
  return AlignedBox3d(Vector3d(x, y, 0.4), Vector3d(x + side, y + side, 0.4 + side));
}

}

TEST(BoundedField, AllOutsideOfTheBoxIsFree)
{
  const HalfSpace field(0.5);
  const BoundedField bounded(field, UnitBounds);
  const FieldScope scope = bounded.Root();
  EXPECT_FALSE(bounded.IsFree({ 0.2, 0.5, 0.5 }, scope));
  EXPECT_TRUE(bounded.IsFree({ 0.8, 0.5, 0.5 }, scope));
  EXPECT_FALSE(bounded.IsFree({ 0, 0, 0 }, scope)) << "the faces are of the box";
  EXPECT_TRUE(bounded.IsFree({ -1e-9, 0.5, 0.5 }, scope));
  EXPECT_TRUE(bounded.IsFree({ 0.2, 1.5, 0.5 }, scope));
}

TEST(BoundedField, BoxesThatLeaveTheBoundsAreNotAllMatter)
{
  const HalfSpace field(0.5);
  const BoundedField bounded(field, UnitBounds);
  const FieldScope root = bounded.Root();
  FieldScope scope;
  EXPECT_EQ(bounded.Classify(FlatBoxAt(0.1, 0.1, 0.2), root, scope), BoxContent::Matter);
  EXPECT_EQ(bounded.Classify(FlatBoxAt(0.1, 0.9, 0.2), root, scope), BoxContent::Mixed);
  EXPECT_EQ(bounded.Classify(FlatBoxAt(0.4, 0.1, 0.2), root, scope), BoxContent::Mixed);
  EXPECT_EQ(bounded.Classify(FlatBoxAt(0.6, 0.9, 0.2), root, scope), BoxContent::Free);
  EXPECT_EQ(bounded.Classify(FlatBoxAt(-0.5, 0.1, 0.2), root, scope), BoxContent::Free);
}

TEST(BoundedField, ContentAgreesWithThePoints)
{
  const HalfSpace field(0.5);
  const BoundedField bounded(field, UnitBounds);
  const FieldScope root = bounded.Root();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.5, 1.3), side(0.01, 0.6), share(0, 1);
  int decided = 0;
  for (int trial = 0; trial < 1000; ++trial)
  {
    const AlignedBox3d box = FlatBoxAt(place(random), place(random), side(random));
    FieldScope scope;
    const BoxContent content = bounded.Classify(box, root, scope);
    decided += content != BoxContent::Mixed;
    for (int i = 0; i < 20 && content != BoxContent::Mixed; ++i)
    {
      const Vector3d point =
        box.min() + box.sizes().cwiseProduct(Vector3d(share(random), share(random), share(random)));
      EXPECT_EQ(bounded.IsFree(point, root), content == BoxContent::Free);
    }
  }
  EXPECT_GT(decided, 400);
}

// Bisection is the truth.
TEST(BoundedField, CrossingsAreTheFieldsOrThoseOfTheBounds)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> inside(0, 1), around(-1, 2);
  int atBounds = 0, atField = 0;
  for (const double height : { 0.5, 3.0 })
  {
    const HalfSpace field(height);
    const BoundedField bounded(field, UnitBounds);
    const FieldScope scope = bounded.Root();
    for (int trial = 0; trial < 2000; ++trial)
    {
      const Vector3d matter(inside(random), inside(random), inside(random));
      const Vector3d free(around(random), around(random), around(random));
      if (bounded.IsFree(matter, scope) || !bounded.IsFree(free, scope))
      {
        continue;
      }
      double low = 0, high = 1;
      while (high - low > 1e-12)
      {
        const double middle = 0.5 * (low + high);
        (bounded.IsFree(matter + middle * (free - matter), scope) ? high : low) = middle;
      }
      double place = -1;
      SurfaceLabel label;
      ASSERT_TRUE(bounded.Crossing(matter, free, scope, place, label));
      EXPECT_NEAR(place, high, 1e-9);
      const double x = matter.x() + place * (free.x() - matter.x());
      if (std::abs(x - height) < 1e-9)
      {
        EXPECT_EQ(label.view, 5);
        ++atField;
      }
      else
      {
        EXPECT_EQ(label.view, -1);
        EXPECT_EQ(label.kind, SurfaceKind::Hull);
        EXPECT_LT((label.normal - (free - matter).normalized()).norm(), 1e-12);
        ++atBounds;
      }
    }
  }
  EXPECT_GT(atBounds, 500);
  EXPECT_GT(atField, 200);
}

TEST(BoundedField, LabelsOutsideAreOfNoView)
{
  const HalfSpace field(0.5);
  const BoundedField bounded(field, UnitBounds);
  EXPECT_EQ(bounded.Label({ 0.6, 0.5, 0.5 }, { 0.4, 0.5, 0.5 }, {}).view, 5);
  const SurfaceLabel label = bounded.Label({ 0.4, 1.1, 0.5 }, { 0.4, 0.9, 0.5 }, {});
  EXPECT_EQ(label.view, -1);
  EXPECT_EQ(label.kind, SurfaceKind::Hull);
  EXPECT_LT((label.normal - Vector3d(0, 1, 0)).norm(), 1e-12);
}
