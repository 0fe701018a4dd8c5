// SPDX-License-Identifier: BSD-3-Clause
#include "Support/ErrorObserver.h"
#include "Support/PlainSettings.h"
#include "vtkOccupancyMapWriter.h"

#include "Data/ViewBlocks.h"
#include "Texture/DisparityImage.h"
#include "vtkFreespaceUnion.h"
#include "Support/TemporaryFolder.h"

#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <vector>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

// A view from z = 0 of a wall with a step, 3 and 4 away, over the middle half of its image.
DisparityMap StepMap()
{
  DisparityMap map;
  map.name = "step";
  map.camera.K << 100, 0, 50, 0, 100, 40, 0, 0, 1;
  map.camera.width = 100;
  map.camera.height = 80;
  for (int i = 0; i < 6; ++i)
  {
    const Eigen::Vector2d pixel(25 + 25 * (i % 3), i / 3 ? 60 : 20);
    map.imagePoints.push_back(pixel);
    map.points.push_back(map.camera.Unproject(pixel, i % 3 == 2 ? 4 : 3));
    map.sourceView.push_back(0);
  }
  map.triangles = { { 0, 3, 1 }, { 1, 3, 4 }, { 1, 4, 2 }, { 2, 4, 5 } };
  return map;
}

vtkSmartPointer<vtkMultiBlockDataSet> Maps()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  SetNamedBlock(blocks, 0, "step", BlockFromMap(StepMap()));
  return blocks;
}

int Write(const std::string& fileName, vtkMultiBlockDataSet* maps, double resolution = 0.02)
{
  vtkNew<vtkOccupancyMapWriter> writer;
  SetPlain(writer.Get());
  writer->SetInputDataObject(maps);
  writer->SetFileName(fileName);
  writer->SetResolution(resolution);
  writer->SetHullMargin(0.2);
  return writer->Write();
}

void ExpectAgreement(const octomap::OcTree& tree)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  auto maps = Maps();
  phi->SetMaps(maps);
  phi->SetHullMargin(0.2);
  phi->Update();
  double bounds[6];
  phi->GetBounds(bounds);
  const DisparityMap map = StepMap();
  const DisparityImage image = RenderDisparity({ map.points, map.triangles }, map.camera);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int counts[3] = { 0, 0, 0 };
  for (int i = 0; i < 5000; ++i)
  {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = bounds[2 * axis] + unit(random) * (bounds[2 * axis + 1] - bounds[2 * axis]);
      point[axis] = (std::floor(at / 0.02) + 0.5) * 0.02; // the middle of a cell
    }
    const Eigen::Vector2d pixel = map.camera.Project(point);
    const bool looked = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < 100 && pixel.y() < 80 &&
      image.At(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())) > 0;
    const octomap::OcTreeNode* node =
      tree.search(octomap::point3d(point.x(), point.y(), point.z()));
    ASSERT_EQ(node != nullptr, looked) << point.transpose();
    if (node)
    {
      const bool free = phi->IsPointFree(point.data());
      EXPECT_EQ(tree.isNodeOccupied(node), !free) << point.transpose();
      const double value = phi->EvaluateFunction(point.data());
      EXPECT_TRUE(free == (value > 0) || std::abs(value) < 1e-12) << point.transpose();
      ++counts[free ? 1 : 2];
    }
    else
    {
      ++counts[0];
    }
  }
  EXPECT_GT(counts[0], 100);
  EXPECT_GT(counts[1], 100);
  EXPECT_GT(counts[2], 100);
}

}

TEST(OccupancyMapWriter, BinaryTreeAgreesWithPhi)
{
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(folder + "/map.bt", Maps()), 1);
  octomap::OcTree tree(folder + "/map.bt");
  EXPECT_NEAR(tree.getResolution(), 0.02, 1e-9);
  ExpectAgreement(tree);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

// A shift by whole cells moves the cells, and leaves what is in them. OctoMap reads a comment over.
TEST(OccupancyMapWriter, AGlobalShiftMovesTheMap)
{
  const freespace::TemporaryFolder temporary;
  for (const char* ending : { ".bt", ".ot" })
  {
    std::unique_ptr<octomap::AbstractOcTree> trees[2];
    for (const int is : { 0, 1 })
    {
      const std::string file = temporary.Path(std::to_string(is) + ending);
      vtkNew<vtkOccupancyMapWriter> writer;
      SetPlain(writer.Get());
      writer->SetInputDataObject(Maps());
      writer->SetFileName(file);
      writer->SetResolution(0.0625);
      writer->SetHullMargin(0.2);
      writer->SetGlobalShift(1000 * is, -500 * is, 250 * is);
      ASSERT_EQ(writer->Write(), 1);
      if (std::string(ending) == ".bt")
      {
        trees[is] = std::make_unique<octomap::OcTree>(file);
      }
      else
      {
        trees[is].reset(octomap::AbstractOcTree::read(file));
      }
    }
    const auto *tree = dynamic_cast<octomap::OcTree*>(trees[0].get()),
               *shifted = dynamic_cast<octomap::OcTree*>(trees[1].get());
    ASSERT_TRUE(tree && shifted);
    std::size_t cells = 0;
    for (int i = -40; i < 40; ++i)
    {
      for (int j = -40; j < 40; ++j)
      {
        for (int k = 0; k < 80; k += 3)
        {
          const octomap::point3d at((i + 0.5f) / 16, (j + 0.5f) / 16, (k + 0.5f) / 16);
          const auto *node = tree->search(at),
                     *other = shifted->search(at - octomap::point3d(1000, -500, 250));
          ASSERT_EQ(node == nullptr, other == nullptr);
          ASSERT_TRUE(!node || tree->isNodeOccupied(node) == shifted->isNodeOccupied(other));
          cells += node != nullptr;
        }
      }
    }
    EXPECT_GT(cells, 1000u);
  }
  std::ifstream file(temporary.Path("1.bt"), std::ios::binary);
  std::string first, second;
  std::getline(file, first);
  std::getline(file, second);
  EXPECT_EQ(first, "# Octomap OcTree binary file");
  EXPECT_EQ(second, "# global shift 1000 -500 250");
}

TEST(OccupancyMapWriter, FullTreeAgreesWithPhi)
{
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(folder + "/map.ot", Maps()), 1);
  const std::unique_ptr<octomap::AbstractOcTree> read(
    octomap::AbstractOcTree::read(folder + "/map.ot"));
  const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  ExpectAgreement(*tree);
}

namespace
{

// What a writer tells of its progress, and where it is asked to stop.
struct Watcher
{
  double stopAt = 2.0;
  std::vector<double> seen = {};
  int after = 0;

  static void See(vtkObject* caller, unsigned long, void* data, void* fraction)
  {
    auto* writer = vtkAlgorithm::SafeDownCast(caller);
    auto* self = static_cast<Watcher*>(data);
    self->seen.push_back(*static_cast<double*>(fraction));
    // The last event is the pipeline's own, with VTK 9.3 after an abort, too.
    self->after += writer->GetAbortExecute() != 0 && self->seen.back() < 1;
    if (self->seen.back() >= self->stopAt)
    {
      writer->SetAbortExecute(1);
    }
  }
};

}

TEST(OccupancyMapWriter, ProgressMovesAndAWishToStopIsHeardEverywhere)
{
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  for (const char* ending : { ".bt", ".ot" })
  {
    // While Phi is built, the maps are drawn, the map is filled, pruned and written.
    for (const double stopAt : { 2.0, 0.0, 0.1, 0.3, 0.41, 0.6, 0.8, 0.9, 0.91 })
    {
      vtkNew<vtkOccupancyMapWriter> writer;
      SetPlain(writer.Get());
      writer->SetInputDataObject(Maps());
      writer->SetFileName(folder + "/map" + ending);
      writer->SetResolution(0.02);
      writer->SetHullMargin(0.2);
      Watcher watcher{ stopAt };
      vtkNew<vtkCallbackCommand> see;
      see->SetClientData(&watcher);
      see->SetCallback(Watcher::See);
      writer->AddObserver(vtkCommand::ProgressEvent, see);
      EXPECT_EQ(writer->Write(), stopAt > 1);
      EXPECT_TRUE(std::is_sorted(watcher.seen.begin(), watcher.seen.end()));
      EXPECT_EQ(fs::remove(folder + "/map" + ending), stopAt > 1);
      EXPECT_TRUE(fs::is_empty(folder));
      if (stopAt > 1)
      {
        EXPECT_GT(watcher.seen.size(), 100u);
        EXPECT_EQ(watcher.seen.back(), 1.0);
        continue;
      }
      EXPECT_EQ(writer->GetErrorCode(), vtkErrorCode::UserError);
      EXPECT_EQ(watcher.after, stopAt > 0 ? 0 : 1); // the first event is the pipeline's own
    }
  }
}

// Of the package octomap-tools.
TEST(OccupancyMapWriter, ToolsOfOctoMapReadIt)
{
  const std::string tool = FREESPACE_CONVERT_OCTREE;
  if (!fs::exists(tool))
  {
    GTEST_SKIP() << "octomap-tools are not installed";
  }
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(folder + "/map.bt", Maps()), 1);
  const std::string command = tool + " " + folder + "/map.bt " + folder + "/again.ot > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::unique_ptr<octomap::AbstractOcTree> read(
    octomap::AbstractOcTree::read(folder + "/again.ot"));
  const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  ExpectAgreement(*tree);
}

TEST(OccupancyMapWriter, FaultsAreErrors)
{
  ExpectedErrors errors;
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  EXPECT_EQ(Write("/nowhere/at/all/map.bt", Maps()), 0);
  EXPECT_TRUE(errors.Has("/nowhere/at/all"));
  EXPECT_EQ(Write(folder + "/map.xyz", Maps()), 0);
  EXPECT_TRUE(errors.Has("map.xyz"));
  EXPECT_EQ(Write(folder + "/map.bt", vtkSmartPointer<vtkMultiBlockDataSet>::New()), 0);
  EXPECT_TRUE(errors.Has("the disparity maps have no features"));
  EXPECT_EQ(Write(folder + "/map.bt", Maps(), 1e-6), 0);
  EXPECT_TRUE(errors.Has("A resolution of 0.000001"));
  EXPECT_TRUE(fs::is_empty(folder));
}
