// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SilhouetteBlocks.h"

#include "Data/ViewBlocks.h"
#include "Support/RandomMaps.h"
#include "vtkDelaunayDisparityFilter.h"
#include "vtkMergeViewsFilter.h"
#include "vtkOutlierFilter.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace freespace;

namespace
{

DisparityMap Silhouette(const std::string& name)
{
  DisparityMap map = RandomMaps(3, 1).front();
  map.name = name;
  map.sourceView.assign(map.points.size(), -1);
  return map;
}

// Two views with a silhouette between them and one behind.
vtkSmartPointer<vtkMultiBlockDataSet> SquareBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const std::vector<DisparityMap> maps = RandomMaps(5, 2);
  SetNamedBlock(blocks, 0, "first", BlockFromView(maps[0]));
  SetNamedBlock(blocks, 1, "a (mask)", BlockFromMap(Silhouette("a (mask)")));
  SetNamedBlock(blocks, 2, "second", BlockFromView(maps[1]));
  SetNamedBlock(blocks, 3, "b (mask)", BlockFromMap(Silhouette("b (mask)")));
  return blocks;
}

void ExpectViewsThenSilhouettes(vtkMultiBlockDataSet* output)
{
  ASSERT_EQ(output->GetNumberOfBlocks(), 4u);
  const char* const names[] = { "first", "second", "a (mask)", "b (mask)" };
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(BlockName(output, i), names[i]);
    EXPECT_EQ(IsSilhouette(output->GetBlock(i)), i >= 2);
  }
  const DisparityMap expected = Silhouette("a (mask)");
  const DisparityMap passed = MapFromBlocks(output, 2);
  EXPECT_EQ(passed.points, expected.points);
  EXPECT_EQ(passed.triangles, expected.triangles);
  EXPECT_EQ(passed.sourceView, expected.sourceView);
}

}

TEST(SilhouetteBlocks, AreMapsWithoutAnyFeature)
{
  DisparityMap map = Silhouette("a");
  EXPECT_TRUE(IsSilhouette(BlockFromMap(map)));
  map.sourceView.back() = 0;
  EXPECT_FALSE(IsSilhouette(BlockFromMap(map)));
  map.sourceView.back() = -1;
  map.triangles.clear();
  EXPECT_FALSE(IsSilhouette(BlockFromMap(map)));
  EXPECT_FALSE(IsSilhouette(BlockFromView(map)));
  EXPECT_FALSE(IsSilhouette(nullptr));
}

TEST(SilhouetteBlocks, AreToldFromViews)
{
  const auto blocks = SquareBlocks();
  EXPECT_EQ(NumberOfSilhouettes(blocks), 2u);
  const auto views = WithoutSilhouettes(blocks);
  ASSERT_EQ(views->GetNumberOfBlocks(), 2u);
  EXPECT_EQ(BlockName(views, 1), "second");
  EXPECT_EQ(WithoutSilhouettes(views), views);
}

TEST(SilhouetteBlocks, PassThroughTheFiltersOfViews)
{
  vtkNew<vtkOutlierFilter> outliers;
  outliers->SetSupport(0);
  outliers->SetInputDataObject(SquareBlocks());
  outliers->Update();
  ExpectViewsThenSilhouettes(outliers->GetOutput());

  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(SquareBlocks());
  merge->Update();
  ExpectViewsThenSilhouettes(merge->GetOutput());

  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetSupport(0);
  maps->SetInputDataObject(SquareBlocks());
  maps->Update();
  ExpectViewsThenSilhouettes(maps->GetOutput());
  EXPECT_GT(MapFromBlocks(maps->GetOutput(), 1).triangles.size(), 0u);
}
