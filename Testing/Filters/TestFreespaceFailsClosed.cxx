// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceUnion.h"

#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"
#include "Support/RandomMaps.h"

#include <vtkDoubleArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

const double Far[3] = { 100, 100, 100 };
const double Farther[3] = { 101, 100, 100 };
const double FarBox[6] = { 100, 101, 100, 101, 100, 101 };

vtkSmartPointer<vtkFreespaceUnion> MakeUnion(bool isValid)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  if (isValid)
  {
    freespace::SetNamedBlock(
      blocks, 0, "view", freespace::BlockFromMap(freespace::RandomMaps(1, 1).front()));
  }
  else
  {
    blocks->SetBlock(0, vtkSmartPointer<vtkPolyData>::New()); // without a camera
  }
  auto phi = vtkSmartPointer<vtkFreespaceUnion>::New();
  phi->SetMaps(blocks);
  return phi;
}

}

TEST(FreespaceFailsClosed, WhereAllIsFreeItIs)
{
  const auto phi = MakeUnion(true);
  EXPECT_TRUE(phi->IsPointFree(Far));
  EXPECT_TRUE(phi->IsSegmentFree(Far, Farther));
  EXPECT_TRUE(phi->IsSphereFree(Far, 1));
  EXPECT_TRUE(phi->IsBoxFree(FarBox));
}

TEST(FreespaceFailsClosed, NothingIsFreeWithoutValidMaps)
{
  const auto phi = MakeUnion(false);
  EXPECT_FALSE(phi->IsValid());
  EXPECT_FALSE(phi->IsPointFree(Far));
  EXPECT_EQ(phi->FirstBlocked(Far, Farther), 0);
  EXPECT_FALSE(phi->IsSegmentFree(Far, Farther));
  EXPECT_FALSE(phi->IsSphereFree(Far, 1));
  EXPECT_FALSE(phi->IsBoxFree(FarBox));
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(Far);
  vtkNew<vtkDoubleArray> radii;
  radii->InsertNextValue(1);
  vtkNew<vtkUnsignedCharArray> free;
  vtkNew<vtkDoubleArray> fractions;
  phi->ArePointsFree(points, free);
  EXPECT_TRUE(free->GetNumberOfValues() == 0 || free->GetValue(0) == 0);
  phi->AreSpheresFree(points, radii, free);
  EXPECT_TRUE(free->GetNumberOfValues() == 0 || free->GetValue(0) == 0);
  phi->FirstBlocked(points, points, fractions);
  EXPECT_TRUE(fractions->GetNumberOfValues() == 0 || fractions->GetValue(0) == 0);
}

TEST(FreespaceFailsClosed, PointsHaveThreeStates)
{
  const auto phi = MakeUnion(true);
  EXPECT_EQ(phi->GetPointState(Far), vtkFreespaceUnion::UNKNOWN);
  double b[6];
  phi->Update();
  phi->GetBounds(b);
  int counts[3] = { 0, 0, 0 };
  for (int i = 0; i < 1000; ++i)
  {
    const double f[3] = { i % 10 / 9.0, i / 10 % 10 / 9.0, i / 100 / 9.0 };
    double point[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = b[2 * axis] + f[axis] * (b[2 * axis + 1] - b[2 * axis]);
    }
    const int state = phi->GetPointState(point);
    ++counts[state];
    EXPECT_EQ(state != vtkFreespaceUnion::MATTER, phi->IsPointFree(point));
  }
  EXPECT_GT(counts[vtkFreespaceUnion::MATTER], 0);
  EXPECT_GT(counts[vtkFreespaceUnion::FREE], 0);
}

TEST(FreespaceFailsClosed, NothingInPlaceOfABatch)
{
  freespace::ExpectedErrors errors;
  const auto phi = MakeUnion(true);
  vtkNew<vtkPoints> points;
  EXPECT_FALSE(phi->ArePointsFree(nullptr, nullptr));
  EXPECT_TRUE(errors.Has("A batch has no points"));
  EXPECT_FALSE(phi->GetPointStates(points, nullptr));
  EXPECT_TRUE(errors.Has("A batch has no points"));
  EXPECT_FALSE(phi->FirstBlocked(points, nullptr, nullptr));
  EXPECT_TRUE(errors.Has("A batch has no points"));
  EXPECT_FALSE(phi->AreSpheresFree(points, nullptr, nullptr));
  EXPECT_TRUE(errors.Has("A batch has no points"));
}

// The union alone keeps what makes its maps.
TEST(FreespaceFailsClosed, TheProducerLivesAsLongAsTheUnion)
{
  vtkNew<vtkFreespaceUnion> phi;
  {
    vtkNew<vtkTrivialProducer> producer;
    producer->SetOutput(MakeUnion(true)->GetMaps());
    phi->SetInputConnection(producer->GetOutputPort());
  }
  EXPECT_TRUE(phi->IsPointFree(Far));
  EXPECT_GT(phi->GetMTime(), 0u);
}

TEST(FreespaceFailsClosed, WhatIsNotFiniteIsNotFree)
{
  const auto phi = MakeUnion(true);
  for (const double number : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    const double point[3] = { 100, number, 100 };
    EXPECT_FALSE(phi->IsPointFree(point));
    EXPECT_FALSE(phi->IsSegmentFree(Far, point));
    EXPECT_FALSE(phi->IsSphereFree(point, 1));
    EXPECT_FALSE(phi->IsSphereFree(Far, number));
  }
}
