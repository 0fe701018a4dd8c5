// SPDX-License-Identifier: BSD-3-Clause
#include "Data/ViewBlocks.h"

#include "Common/Error.h"
#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"
#include "vtkOutlierFilter.h"
#include "vtkViewBlocksReader.h"
#include "vtkViewBlocksWriter.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

DisparityMap MakeMap(int index)
{
  DisparityMap map;
  map.name = "map" + std::to_string(index);
  map.imageFile = "c.jpg";
  map.camera.K << 100, 0, 50.5, 0, 110, 40, 0, 0, 1;
  map.camera.R = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  map.camera.t = { 0.1, 0.2, 0.3 * index };
  map.camera.width = 100;
  map.camera.height = 80;
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(10, 10), Eigen::Vector2d(60, 12), Eigen::Vector2d(30, 70) })
  {
    map.points.push_back(map.camera.Unproject(pixel, 2.0));
    map.imagePoints.push_back(pixel);
  }
  map.sourceView = { index, index, 5 };
  map.triangles = { { 0, 1, 2 } };
  return map;
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (int i = 0; i < 2; ++i)
  {
    SetNamedBlock(blocks, i, MakeMap(i).name, BlockFromMap(MakeMap(i)));
  }
  return blocks;
}

void ExpectSame(const DisparityMap& a, const DisparityMap& b)
{
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.imageFile, b.imageFile);
  EXPECT_EQ(a.camera.K, b.camera.K);
  EXPECT_EQ(a.camera.R, b.camera.R);
  EXPECT_EQ(a.camera.t, b.camera.t);
  EXPECT_EQ(a.camera.width, b.camera.width);
  EXPECT_EQ(a.camera.height, b.camera.height);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.imagePoints, b.imagePoints);
  EXPECT_EQ(a.sourceView, b.sourceView);
  EXPECT_EQ(a.triangles, b.triangles);
}

}

TEST(ViewBlocks, RoundTripInMemory)
{
  const std::vector<DisparityMap> maps = MapsFromBlocks(MakeBlocks());
  ASSERT_EQ(maps.size(), 2u);
  ExpectSame(maps[0], MakeMap(0));
  ExpectSame(maps[1], MakeMap(1));
}

TEST(ViewBlocks, RoundTripOnDisk)
{
  const TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  const std::string file = folder + "/maps.vtm";
  for (const bool isInline : { false, true }) // the second replaces the first
  {
    vtkNew<vtkViewBlocksWriter> writer;
    writer->SetInputDataObject(MakeBlocks());
    writer->SetFileName(file);
    writer->SetInlineArrays(isInline);
    ASSERT_EQ(writer->Write(), 1);
    vtkNew<vtkViewBlocksReader> reader;
    reader->SetFileName(file);
    reader->Update();
    const std::vector<DisparityMap> maps = MapsFromBlocks(reader->GetOutput());
    ASSERT_EQ(maps.size(), 2u);
    ExpectSame(maps[1], MakeMap(1));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2)
    << "something half-written was left behind";
}

TEST(ViewBlocks, AFolderOfTheSameNameKeepsWhatIsNotItsPart)
{
  const TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  fs::create_directories(folder + "/scene/scene_1");
  for (const char* name : { "scene.json", "scene_7.vtp", "scene_3.jpg", "scene_1/picture.jpg" })
  {
    std::ofstream(folder + "/scene/" + name) << name;
  }
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(MakeBlocks());
  writer->SetFileName(folder + "/scene.vtm");
  ASSERT_EQ(writer->Write(), 1);
  for (const char* name : { "scene.json", "scene_3.jpg", "scene_1/picture.jpg", "scene_0.vtp" })
  {
    EXPECT_TRUE(fs::exists(folder + "/scene/" + name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder + "/scene/scene_7.vtp")) << "a part of a former target";
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(folder + "/scene.vtm");
  reader->Update();
  EXPECT_EQ(MapsFromBlocks(reader->GetOutput()).size(), 2u);
}

TEST(ViewBlocks, UnwritableFolderIsAnError)
{
  ExpectedErrors errors;
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(MakeBlocks());
  writer->SetFileName("/nowhere/at/all/maps.vtm");
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(errors.Has("/nowhere/at/all"));
}

TEST(ViewBlocks, TruncatedFileIsAnError)
{
  ExpectedErrors errors;
  const TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  const std::string file = folder + "/maps.vtm";
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(MakeBlocks());
  writer->SetFileName(file);
  ASSERT_EQ(writer->Write(), 1);
  const std::string block = folder + "/maps/maps_1.vtp";
  ASSERT_TRUE(fs::exists(block));
  fs::resize_file(block, fs::file_size(block) / 2);
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(file);
  reader->Update();
  EXPECT_TRUE(errors.Has("maps_1.vtp"));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(ViewBlocks, MissingArrayNamesTheView)
{
  auto blocks = MakeBlocks();
  vtkPolyData::SafeDownCast(blocks->GetBlock(1))->GetPointData()->RemoveArray("ImagePoint");
  try
  {
    ViewsFromBlocks(blocks);
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("map1"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("ImagePoint"), std::string::npos);
  }
}

TEST(ViewBlocks, LinesAreEdges)
{
  View view = MakeMap(0);
  view.edges = { { 0, 1 }, { 2, 1 } };
  auto block = BlockFromView(view);
  EXPECT_EQ(ViewFromBlock(block, "view").edges, view.edges);

  vtkNew<vtkCellArray> chain;
  const vtkIdType ids[3] = { 2, 0, 1 };
  chain->InsertNextCell(3, ids);
  block->SetLines(chain);
  EXPECT_EQ(
    ViewFromBlock(block, "view").edges, (std::vector<std::array<int, 2>>{ { 2, 0 }, { 0, 1 } }));

  const vtkIdType wrong[2] = { 0, 3 };
  chain->InsertNextCell(2, wrong);
  EXPECT_THROW(ViewFromBlock(block, "view"), Error);
}

// Bytes that are no UTF-8, and control characters, which XML does not know.
TEST(ViewBlocks, NamesThatAreNotUtf8ComeBack)
{
  const TemporaryFolder folder;
  const std::string name = "caf\xe9\n0";
  View view = MakeMap(0);
  view.name = name;
  view.imageFile = name + ".jpg";
  vtkNew<vtkMultiBlockDataSet> blocks;
  SetNamedBlock(blocks, 0, name, BlockFromView(view));
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(blocks);
  writer->SetFileName(folder.Path("views.vtm"));
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_EQ(BlockName(blocks, 0), name) << "the input is left alone";
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(folder.Path("views.vtm"));
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  const std::vector<View> read = ViewsFromBlocks(reader->GetOutput());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, name);
  EXPECT_EQ(read[0].imageFile, name + ".jpg");
}

// As many values as there should be, but not a tuple for each point.
TEST(ViewBlocks, ArraysOfAnotherShapeAreErrors)
{
  const View view = MakeMap(0);
  const auto block = BlockFromView(view);
  const vtkIdType count = block->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> wide;
  wide->SetName("ImagePoint");
  wide->SetNumberOfComponents(static_cast<int>(2 * count));
  wide->SetNumberOfTuples(1);
  wide->Fill(1);
  block->GetPointData()->AddArray(wide);
  EXPECT_THROW(ViewFromBlock(block, "view"), Error);
  const auto map = BlockFromView(view);
  vtkNew<vtkIntArray> source;
  source->SetName("SourceView");
  map->GetPointData()->AddArray(source);
  EXPECT_THROW(MapFromBlock(map, "view", 0), Error) << "too short";
}
