// SPDX-License-Identifier: BSD-3-Clause
#include "Support/SharedData.h"
#include "Support/Scenes/SquaresScene.h"
#include "Support/TemporaryFolder.h"
#include "vtkEdgeStereoReader.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <sstream>

using namespace freespace;

namespace
{

void KeepText(vtkObject*, unsigned long, void* client, void* text)
{
  static_cast<std::string*>(client)->append(static_cast<const char*>(text));
}

// What the reader complains about; empty when it does not.
std::string Complaint(vtkAlgorithm* algorithm)
{
  std::string text;
  vtkNew<vtkCallbackCommand> keep;
  keep->SetCallback(KeepText);
  keep->SetClientData(&text);
  algorithm->AddObserver(vtkCommand::ErrorEvent, keep);
  algorithm->Update();
  algorithm->RemoveObserver(keep);
  return text;
}

vtkPolyData* Block(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  return vtkPolyData::SafeDownCast(blocks->GetBlock(index));
}

void ExpectSamePoints(vtkPolyData* a, vtkPolyData* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(a->GetPoint(i)[c], b->GetPoint(i)[c]);
    }
  }
}

}

TEST(EdgeStereoReader, ArraysAndCells)
{
  const SquaresScene scene(1);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  reader->Update();
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 1u);
  vtkPolyData* block = Block(reader->GetOutput(), 0);
  const vtkIdType count = block->GetNumberOfPoints();
  EXPECT_GT(count, 800);
  EXPECT_EQ(block->GetNumberOfVerts(), count);
  std::set<int> chains;
  for (vtkIdType i = 0; i < count; ++i)
  {
    chains.insert(static_cast<int>(block->GetPointData()->GetArray("ChainId")->GetTuple1(i)));
  }
  chains.erase(-1); // patches
  EXPECT_EQ(block->GetNumberOfLines(), static_cast<vtkIdType>(chains.size()));
  EXPECT_GT(chains.size(), 20u);
  const std::pair<const char*, int> arrays[] = { { "ImagePoint", 2 }, { "RGB", 3 },
    { "EdgeDirection", 3 }, { "MatchingCost", 1 }, { "ChainId", 1 } };
  for (const auto& [name, components] : arrays)
  {
    vtkDataArray* array = block->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetNumberOfComponents(), components) << name;
    EXPECT_EQ(array->GetNumberOfTuples(), count) << name;
  }
}

TEST(EdgeStereoReader, SameForAnyNumberOfThreads)
{
  const SquaresScene scene(5);
  vtkNew<vtkMultiBlockDataSet> first;
  for (int threads : { 1, 2, 4 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads),
      [&]()
      {
        vtkNew<vtkEdgeStereoReader> reader;
        reader->EveryImageOff(); // views of the references alone
        reader->SetFileName(scene.File);
        reader->Update();
        ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 5u);
        if (threads == 1)
        {
          first->DeepCopy(reader->GetOutput());
        }
        for (unsigned int i = 0; i < 5; ++i)
        {
          ExpectSamePoints(Block(first, i), Block(reader->GetOutput(), i));
        }
      });
  }
}

TEST(EdgeStereoReader, EveryImageMakesAView)
{
  const SquaresScene scene(2); // of the same images
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  reader->Update();
  vtkNew<vtkMultiBlockDataSet> middles;
  middles->DeepCopy(reader->GetOutput());
  reader->EveryImageOn();
  reader->Update();
  vtkMultiBlockDataSet* views = reader->GetOutput();
  ASSERT_EQ(views->GetNumberOfBlocks(), 4u);
  const char* names[4] = { "cluster0", "cluster1", "cluster0_l", "cluster0_r" };
  const char* files[4] = { "c.png", "c.png", "l.png", "r.png" };
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_STREQ(views->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()), names[i]);
    EXPECT_EQ(
      Block(views, i)->GetFieldData()->GetAbstractArray("ImageFile")->GetVariantValue(0), files[i]);
    EXPECT_GT(Block(views, i)->GetNumberOfPoints(), 800);
  }
  for (unsigned int i = 0; i < 2; ++i)
  {
    ExpectSamePoints(Block(middles, i), Block(views, i));
  }
  // The plane that the squares are painted on, as the middle view has it.
  double bounds[6];
  Block(views, 0)->GetBounds(bounds);
  for (unsigned int i = 2; i < 4; ++i)
  {
    for (vtkIdType p = 0; p < Block(views, i)->GetNumberOfPoints(); ++p)
    {
      const double z = Block(views, i)->GetPoint(p)[2];
      ASSERT_GT(z, bounds[4] - 0.05);
      ASSERT_LT(z, bounds[5] + 0.05);
    }
  }
}

TEST(EdgeStereoReader, RunsAgainWhenTheFileChanges)
{
  const SquaresScene scene(2);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  reader->Update();
  const vtkMTimeType before = reader->GetOutput()->GetMTime();
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetMTime(), before);
  vtkMTimeType last = before;
  for (const char* name : { "scene.json", "sparse/cameras.txt", "images/l.png" })
  {
    const std::filesystem::path file = scene.Folder.Path(name);
    std::filesystem::last_write_time(
      file, std::filesystem::last_write_time(file) + std::chrono::seconds(5));
    reader->Update();
    EXPECT_GT(reader->GetOutput()->GetMTime(), last) << name;
    last = reader->GetOutput()->GetMTime();
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetMTime(), last) << name;
  }
}

TEST(EdgeStereoReader, AbortLeavesNothing)
{
  const SquaresScene scene(3);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  reader->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(Complaint(reader), "");
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(EdgeStereoReader, ProgressMovesWhileImagesAreMatched)
{
  const SquaresScene scene(3);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  std::vector<double> seen;
  vtkNew<vtkCallbackCommand> see;
  see->SetClientData(&seen);
  see->SetCallback([](vtkObject*, unsigned long, void* list, void* fraction)
    { static_cast<std::vector<double>*>(list)->push_back(*static_cast<double*>(fraction)); });
  reader->AddObserver(vtkCommand::ProgressEvent, see);
  EXPECT_EQ(Complaint(reader), "");
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back(), 1.0);

  // At the second event the matching has begun. The last one is the pipeline's own, with VTK 9.3 after an abort, too.
  int events = 0;
  vtkNew<vtkCallbackCommand> abort;
  abort->SetClientData(&events);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* count, void* fraction)
    {
      if (*static_cast<double*>(fraction) < 1 && ++*static_cast<int*>(count) == 2)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
      }
    });
  reader->AddObserver(vtkCommand::ProgressEvent, abort);
  reader->Modified();
  EXPECT_EQ(Complaint(reader), "");
  EXPECT_EQ(events, 2);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(EdgeStereoReader, BadInputIsToldAndLeavesNothing)
{
  const SquaresScene scene(2);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.Folder.Path("other.json"));
  EXPECT_NE(Complaint(reader).find("other.json"), std::string::npos);

  reader->SetFileName(scene.File);
  reader->SetTolerance(-1);
  EXPECT_NE(Complaint(reader).find("tolerance"), std::string::npos);
  reader->SetTolerance(0.5);
  EXPECT_EQ(Complaint(reader), "");
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 2u);

  reader->SetMinimumDepth(-1);
  EXPECT_NE(Complaint(reader).find("depth"), std::string::npos);
  reader->SetMinimumDepth(0);
  scene.Folder.Write("images/l.png", "");
  reader->Modified();
  EXPECT_NE(Complaint(reader).find("l.png"), std::string::npos);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(EdgeStereoReader, DepthLimits)
{
  const SquaresScene scene(1);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  reader->SetMinimumDepth(0.9);
  reader->SetMaximumDepth(1.1);
  reader->Update();
  EXPECT_GT(Block(reader->GetOutput(), 0)->GetNumberOfPoints(), 800);
  reader->SetMaximumDepth(0.95); // nothing there
  EXPECT_NE(Complaint(reader).find("cluster0"), std::string::npos);
}

// The blocks scene's figures that need no truth: where they fall, something is broken.
TEST(EdgeStereoReader, BlocksSceneGivesEnoughFeatures)
{
  const std::string scene = SharedData("blocks/scene.json");
  if (scene.empty())
  {
    GTEST_SKIP() << "The blocks scene is not there.";
  }
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene);
  reader->Update();
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 6u);
  for (unsigned int i = 0; i < 6; ++i)
  {
    vtkPolyData* block = Block(reader->GetOutput(), i);
    EXPECT_GT(block->GetNumberOfPoints(), 25000) << i;
    int onBoard = 0, below = 0; // the board is the plane z = 0
    for (vtkIdType k = 0; k < block->GetNumberOfPoints(); ++k)
    {
      const double z = block->GetPoint(k)[2];
      onBoard += std::abs(z) < 0.0005;
      below += z < -0.003;
    }
    EXPECT_GT(onBoard, 8000) << i;
    EXPECT_LT(below, 5) << i;
  }
}
