// SPDX-License-Identifier: BSD-3-Clause
// Views that are added to a vtkFreespaceUnion and removed from it.
#include "vtkFreespaceUnion.h"

#include "Data/ViewEdits.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/ErrorObserver.h"
#include "Support/RandomMapBlocks.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>

#include <gtest/gtest.h>

#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

vtkPolyData* MapOf(vtkMultiBlockDataSet* maps, unsigned int i)
{
  return vtkPolyData::SafeDownCast(maps->GetBlock(i));
}

// Exactly the answers of a union that never had other maps.
void ExpectAsFromNothing(vtkFreespaceUnion* phi, std::mt19937& random)
{
  vtkNew<vtkMultiBlockDataSet> copy;
  copy->DeepCopy(phi->GetMaps());
  vtkNew<vtkFreespaceUnion> fresh;
  fresh->SetMinimumViews(phi->GetMinimumViews());
  fresh->SetMaps(copy);
  const auto now = phi->GetCore(), expected = fresh->GetCore();
  ASSERT_TRUE(now && expected);
  ASSERT_EQ(now->NumberOfViews(), expected->NumberOfViews());
  EXPECT_EQ(now->Cells(), expected->Cells());
  EXPECT_EQ(now->Features(), expected->Features());
  EXPECT_EQ(now->FeatureRegion().features, expected->FeatureRegion().features);
  ASSERT_EQ(now->Hull().NumberOfPlanes(), expected->Hull().NumberOfPlanes());
  EXPECT_EQ(now->Hull().Bounds().min(), expected->Hull().Bounds().min());
  EXPECT_EQ(now->Hull().Bounds().max(), expected->Hull().Bounds().max());
  std::uniform_real_distribution<double> place(-1.6, 1.6);
  for (int i = 0; i < 300; ++i)
  {
    const Vector3d x(place(random), place(random), place(random));
    ASSERT_EQ(now->Value(x), expected->Value(x)) << x.transpose();
    ASSERT_EQ(now->IsFree(x), expected->IsFree(x)) << x.transpose();
  }
}

}

TEST(UnionViews, AreAddedAndRemovedAsFromNothing)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    std::mt19937 random(seed);
    const auto maps = MakeMaps(seed, 8);
    vtkNew<vtkFreespaceUnion> phi;
    phi->SetMinimumViews(seed % 2 ? 1 : -1);
    int added = 0;
    const auto add = [&]
    {
      const unsigned int next = static_cast<unsigned int>(added++ % 8);
      ASSERT_TRUE(
        phi->AddView("view" + std::to_string(next), MapOf(maps, next), static_cast<int>(next)));
    };
    add();
    for (int step = 0; step < 12; ++step)
    {
      const int count = static_cast<int>(phi->GetMaps()->GetNumberOfBlocks());
      if (count > 1 && random() % 3 == 0)
      {
        ASSERT_TRUE(phi->RemoveView(static_cast<int>(random() % count)));
      }
      else
      {
        add();
      }
      ExpectAsFromNothing(phi, random);
    }
  }
}

TEST(UnionViews, OthersAreShared)
{
  const auto maps = MakeMaps(4, 5);
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  const SharedMaps before = phi->GetCore()->GetMaps();
  ASSERT_TRUE(phi->RemoveView("map1"));
  EXPECT_EQ(maps->GetNumberOfBlocks(), 5u) << "what was given does not change";
  SharedMaps now = phi->GetCore()->GetMaps();
  EXPECT_EQ(now, (SharedMaps{ before[0], before[2], before[3], before[4] }));
  ASSERT_TRUE(phi->AddView("map1", MapOf(maps, 1), 1));
  now = phi->GetCore()->GetMaps();
  ASSERT_EQ(now.size(), 5u);
  EXPECT_EQ(now[3], before[4]);
  ASSERT_TRUE(phi->AddView("map3", MapOf(maps, 0), 0)) << "in place of the one of its name";
  EXPECT_EQ(phi->GetCore()->GetMaps()[0], before[0]);
  EXPECT_NE(phi->GetCore()->GetMaps()[2], before[3]);
  EXPECT_EQ(phi->GetCore()->GetMaps().size(), 5u);
  // What is modified in place is read again.
  MapOf(maps, 4)->GetPoints()->SetPoint(0, 0.1, 0.1, 0.1);
  MapOf(phi->GetMaps(), 3)->GetPoints()->Modified();
  phi->Update();
  EXPECT_NE(phi->GetCore()->GetMaps()[3], before[4]);
  EXPECT_EQ(phi->GetCore()->GetMaps()[0], before[0]);
}

TEST(UnionViews, SourceViewFollows)
{
  const auto maps = MakeMaps(9, 4);
  vtkDataArray* source = MapOf(maps, 3)->GetPointData()->GetArray("SourceView");
  source->SetComponent(0, 0, 1); // from the view that is removed
  source->SetComponent(1, 0, 2);
  source->SetComponent(2, 0, 0);
  source->SetComponent(3, 0, -1);
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  ASSERT_TRUE(phi->RemoveView(1));
  EXPECT_EQ(source->GetComponent(4, 0), 3) << "that of the caller";
  vtkDataArray* now = MapOf(phi->GetMaps(), 2)->GetPointData()->GetArray("SourceView");
  const double expected[] = { RemovedView, 1, 0, -1, 2 };
  for (vtkIdType i = 0; i < 5; ++i)
  {
    EXPECT_EQ(now->GetComponent(i, 0), expected[i]);
  }
  EXPECT_EQ(phi->GetMaps()->GetBlock(0), maps->GetBlock(0)) << "nothing to change";
  ASSERT_TRUE(phi->RemoveView(0));
  now = MapOf(phi->GetMaps(), 1)->GetPointData()->GetArray("SourceView");
  EXPECT_EQ(now->GetComponent(0, 0), RemovedView);
  EXPECT_EQ(now->GetComponent(2, 0), RemovedView);
  EXPECT_EQ(now->GetComponent(4, 0), 1);
}

TEST(UnionViews, WhatIsNotThereIsAnError)
{
  const auto maps = MakeMaps(2, 2);
  vtkNew<vtkFreespaceUnion> phi;
  vtkNew<ErrorObserver> errors;
  phi->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_FALSE(phi->RemoveView(0));
  EXPECT_FALSE(phi->AddView("none", nullptr));
  phi->SetMaps(maps);
  EXPECT_FALSE(phi->RemoveView(2));
  EXPECT_FALSE(phi->RemoveView(-1));
  EXPECT_FALSE(phi->RemoveView("map2"));
  EXPECT_EQ(errors->Count, 5);
  EXPECT_NE(errors->Last.find("map2"), std::string::npos);
  EXPECT_EQ(phi->GetMaps(), maps);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(maps);
  phi->SetInputConnection(producer->GetOutputPort());
  EXPECT_FALSE(phi->AddView("map2", MapOf(maps, 0)));
  EXPECT_FALSE(phi->RemoveView("map0"));
  EXPECT_EQ(errors->Count, 7);
  EXPECT_TRUE(phi->IsValid());
}
