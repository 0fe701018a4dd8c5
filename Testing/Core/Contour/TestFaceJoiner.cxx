// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/FaceJoiner.h"

#include "Support/ContourFields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// The blocks of a contour and their joined faces. Keeps a reference to the field.
struct JoinedBlocks
{
  JoinedBlocks(const ContourField& field, double half, int cells)
    : parts(field, Cube(half), Cells(cells))
    , mesh(this->parts.lattice)
  {
    this->parts.Find(Progress(), SerialFor, false);
    this->mesh.Add(this->parts.regions);
    const FaceJoiner joiner(this->parts.field, this->mesh);
    for (BlockPlace& place : this->mesh.places)
    {
      joiner.JoinFaces(place);
    }
  }

  // By cell of the lattice.
  std::map<LatticeIndex, int> Faces() const
  {
    std::map<LatticeIndex, int> faces;
    for (const BlockPlace& place : this->mesh.places)
    {
      EXPECT_TRUE(std::is_sorted(place.joined.begin(), place.joined.end(),
        [](const JoinedFaces& a, const JoinedFaces& b) { return a.cell < b.cell; }));
      for (const JoinedFaces& joined : place.joined)
      {
        EXPECT_NE(joined.faces, 0);
        faces[this->mesh.LatticeCell(*place.block, joined.cell)] = joined.faces;
      }
    }
    return faces;
  }

  ContourOctree parts;
  BlockMesh mesh;
};

// Asks the field itself, cell by cell of the whole lattice.
class BruteForceFaces
{
public:
  BruteForceFaces(const ContourField& field, double half, const ContourLattice& wholeLattice)
    : Field(field)
    , Box(Cube(half))
    , Lattice(wholeLattice)
  {
  }

  // The ambiguous faces with matter in the middle that the cell can join.
  int Wanted(const LatticeIndex& cell) const
  {
    int corners = 0, faces = 0;
    for (int c = 0; c < 8; ++c)
    {
      corners |= this->IsMatter(this->Corner(cell, c)) << c;
    }
    for (int face = 0; face < 6; ++face)
    {
      // The face's corners in turn.
      const int a = 1 << (face / 2 + 1) % 3, b = 1 << (face / 2 + 2) % 3;
      const int first = face % 2 << face / 2,
                turn[4] = { first, first | a, first | a | b, first | b };
      Vector3d middle = Vector3d::Zero();
      int changes = 0;
      for (int i = 0; i < 4; ++i)
      {
        middle += 0.25 * this->Corner(cell, turn[i]);
        changes += (corners >> turn[i] & 1) != (corners >> turn[(i + 1) % 4] & 1);
      }
      faces |= (changes == 4 && this->IsMatter(middle)) << face;
    }
    return MarchingCubesCases::Get().CanJoin(corners, faces) ? faces : 0;
  }

  std::map<LatticeIndex, int> Joined() const
  {
    std::map<LatticeIndex, int> joined;
    for (int k = 0; k < this->Lattice.cells[2]; ++k)
    {
      for (int j = 0; j < this->Lattice.cells[1]; ++j)
      {
        for (int i = 0; i < this->Lattice.cells[0]; ++i)
        {
          const LatticeIndex cell = { i, j, k };
          int faces = this->Wanted(cell);
          for (int face = 0; face < 6; ++face)
          {
            LatticeIndex beside = cell;
            beside[face / 2] += face % 2 ? 1 : -1;
            const int opposite = face % 2 ? face - 1 : face + 1;
            faces &= ~(!(this->Wanted(beside) >> opposite & 1) << face);
          }
          if (faces != 0)
          {
            joined[cell] = faces;
          }
        }
      }
    }
    return joined;
  }

private:
  Vector3d Corner(const LatticeIndex& cell, int c) const
  {
    return this->Lattice.Point(cell[0] + c % 2, cell[1] + c / 2 % 2, cell[2] + c / 4);
  }
  bool IsMatter(const Vector3d& point) const
  {
    return this->Box.contains(point) && !this->Field.IsFree(point, {});
  }

  const ContourField& Field;
  const AlignedBox3d Box;
  const ContourLattice& Lattice;
};

// Balls about some places.
class BallsAbout : public ContourField
{
public:
  BallsAbout(std::vector<Vector3d> middles, double size)
    : Middles(std::move(middles))
    , Radius(size)
  {
  }
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    return std::all_of(this->Middles.begin(), this->Middles.end(),
      [&](const Vector3d& middle) { return (point - middle).norm() > this->Radius; });
  }

private:
  std::vector<Vector3d> Middles;
  double Radius;
};

}

// Two lattice points across a face are in matter; a third ball in the face's middle bridges them or not. The faces lie
// within a block and between two.
TEST(FaceJoiner, MatterInTheMiddleOfAFaceJoinsBothOfItsCells)
{
  const ContourLattice lattice(Cube(1), 20);
  for (const LatticeIndex& at : { LatticeIndex{ 4, 5, 6 }, { 8, 8, 8 }, { 7, 15, 12 } })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d across =
        lattice.spacing * (Vector3d::Unit((axis + 1) % 3) + Vector3d::Unit((axis + 2) % 3));
      const Vector3d point = lattice.Point(at[0], at[1], at[2]);
      const double small = 0.3 * lattice.spacing;
      const BallsAbout apart({ point, point + across }, small);
      EXPECT_TRUE(JoinedBlocks(apart, 1, 20).Faces().empty());
      const BallsAbout bridged({ point, point + across / 2, point + across }, small);
      LatticeIndex below = at;
      --below[axis];
      const std::map<LatticeIndex, int> expected = { { at, 1 << 2 * axis },
        { below, 1 << (2 * axis + 1) } };
      EXPECT_EQ(JoinedBlocks(bridged, 1, 20).Faces(), expected) << axis;
    }
  }
}

TEST(FaceJoiner, AgreesWithBruteForceOnNoise)
{
  std::set<int> seen;
  std::size_t count = 0, refused = 0;
  for (unsigned int seed = 1; seed < 6; ++seed)
  {
    const Noise noise(seed);
    const JoinedBlocks blocks(noise, 1.03, 15);
    const BruteForceFaces truth(noise, 1.03, blocks.mesh.lattice);
    const auto expected = truth.Joined();
    EXPECT_EQ(blocks.Faces(), expected);
    count += expected.size();
    for (const auto& [cell, faces] : expected)
    {
      seen.insert(faces);
      refused += faces != truth.Wanted(cell);
    }
  }
  EXPECT_GT(count, 1000u);
  EXPECT_GT(refused, 30u) << "by the cell beyond";
  for (int face = 0; face < 6; ++face)
  {
    EXPECT_EQ(seen.count(1 << face), 1u);
  }
}

// A scope is only asked for what lies in its box.
TEST(FaceJoiner, ScopesHoldTheFacesThatAreAskedFor)
{
  class NoiseInBoxes : public Noise
  {
  public:
    using Noise::Noise;
    BoxContent Classify(
      const AlignedBox3d& box, const FieldScope&, FieldScope& scope) const override
    {
      scope.views = { static_cast<int>(this->Boxes.size()) };
      this->Boxes.push_back(box);
      return BoxContent::Mixed;
    }
    bool IsFree(const Vector3d& point, const FieldScope& scope) const override
    {
      this->Outside +=
        !scope.views.empty() && this->Boxes[scope.views[0]].exteriorDistance(point) > 1e-9;
      return this->Noise::IsFree(point, scope);
    }
    mutable std::vector<AlignedBox3d> Boxes;
    mutable int Outside = 0;
  };
  const NoiseInBoxes noise(3);
  const JoinedBlocks blocks(noise, 1.03, 15);
  EXPECT_EQ(blocks.Faces(), BruteForceFaces(noise, 1.03, blocks.mesh.lattice).Joined());
  EXPECT_EQ(noise.Outside, 0);
}

TEST(FaceJoiner, ASmoothSurfaceAndNoneHaveNothingToJoin)
{
  const Ball ball;
  EXPECT_TRUE(JoinedBlocks(ball, 1.2, 24).Faces().empty());
  const BallsAbout none({}, 1);
  const JoinedBlocks blocks(none, 1, 8);
  EXPECT_TRUE(blocks.mesh.places.empty());
}
