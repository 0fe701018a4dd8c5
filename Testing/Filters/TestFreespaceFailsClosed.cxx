// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceUnion.h"

#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"

#include <vtkDoubleArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
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
