// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTextureBaker.h"

#include "Common/Error.h"
#include "Support/ErrorObserver.h"
#include "Support/BlockScene.h"
#include "Texture/SurfaceColor.h"
#include "Texture/TextureAtlas.h"
#include "vtkTexturedSurfaceWriter.h"
#include "Support/TemporaryFolder.h"

#include <vtkFloatArray.h>
#include <vtkGLTFReader.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

struct BakedScene
{
  BlockScene scene;
  vtkNew<vtkTextureBaker> baker;

  explicit BakedScene(int photographs = 8)
  {
    this->baker->SetInputData(this->scene.Surface());
    this->baker->SetPhotographs(this->scene.Photographs(photographs));
    this->baker->Update();
  }

  // The texture at a point of a triangle, at the nearest texel, without interpolation.
  std::array<double, 3> Look(vtkIdType triangle, double s, double t, Eigen::Vector3d& point) const
  {
    vtkPolyData* surface = this->baker->GetOutput();
    vtkNew<vtkIdList> ids;
    surface->GetCellPoints(triangle, ids);
    const double weights[3] = { 1 - s - t, s, t };
    point.setZero();
    double u = 0;
    double v = 0;
    for (int i = 0; i < 3; ++i)
    {
      point += weights[i] * Eigen::Vector3d(surface->GetPoint(ids->GetId(i)));
      const double* at = surface->GetPointData()->GetTCoords()->GetTuple(ids->GetId(i));
      u += weights[i] * at[0];
      v += weights[i] * at[1];
    }
    vtkImageData* texture = this->baker->GetTexture();
    const int* size = texture->GetDimensions();
    const auto* texel = static_cast<const unsigned char*>(texture->GetScalarPointer(
      std::min(int(u * size[0]), size[0] - 1), std::min(int(v * size[1]), size[1] - 1), 0));
    return { double(texel[0]), double(texel[1]), double(texel[2]) };
  }
};

int Write(const BakedScene& baked, const std::string& fileName)
{
  vtkNew<vtkTexturedSurfaceWriter> writer;
  writer->SetInputDataObject(0, baked.baker->GetOutput());
  writer->SetInputDataObject(1, baked.baker->GetTexture());
  writer->SetFileName(fileName);
  return writer->Write();
}

}

TEST(TextureBaker, TextureHasTheColoursOfTheSurface)
{
  const BakedScene baked;
  ASSERT_EQ(baked.baker->GetOutput()->GetNumberOfCells(), 12);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double sum = 0;
  double reddest = 0;
  int count = 0;
  for (int i = 0; i < 20000; ++i)
  {
    double s = unit(random);
    double t = unit(random);
    if (s + t > 1)
    {
      s = 1 - s;
      t = 1 - t;
    }
    Eigen::Vector3d point;
    const std::array<double, 3> seen = baked.Look(i % 12, s, t, point);
    const std::array<double, 3> expected = baked.scene.ColorAt(point);
    const double beside = std::max(std::abs(point.x()), std::abs(point.y())) - 1;
    const bool hidden = !baked.scene.IsOnBlock(point) && beside < 0; // below the block
    if (hidden)
    {
      continue;
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      sum += std::abs(expected[channel] - seen[channel]) / 3;
    }
    ++count;
    if (!baked.scene.IsOnBlock(point) && beside > 0.2 && beside < 3.8)
    {
      reddest = std::max(reddest, seen[0]);
    }
  }
  EXPECT_LT(sum / count, 4.0);
  EXPECT_LE(reddest, 10) << "the block on the board behind it";
  EXPECT_LE(baked.baker->GetNumberOfCharts(), 6);
}

TEST(TextureBaker, ATriangleThatIsThereAThousandTimesIsBakedOnce)
{
  BakedScene baked(2);
  const vtkIdType charts = baked.baker->GetNumberOfCharts();
  auto again = vtkSmartPointer<vtkPolyData>::New();
  again->DeepCopy(baked.scene.Surface());
  const vtkIdType once = again->GetNumberOfCells();
  vtkNew<vtkIdList> corners;
  again->GetCellPoints(0, corners);
  for (int i = 0; i < 1000; ++i)
  {
    const vtkIdType turned[3] = { corners->GetId(i % 3), corners->GetId((i + 1) % 3),
      corners->GetId((i + 2) % 3) };
    again->GetPolys()->InsertNextCell(3, turned);
  }
  again->DeleteCells();
  baked.baker->SetInputData(again);
  baked.baker->Update();
  EXPECT_EQ(baked.baker->GetOutput()->GetNumberOfCells(), once);
  EXPECT_EQ(baked.baker->GetNumberOfCharts(), charts);
  EXPECT_EQ(again->GetNumberOfPolys(), once + 1000);
}

TEST(TextureBaker, TexturesAreLimited)
{
  BakedScene baked(2);
  baked.baker->SetLargestTexture(64);
  baked.baker->Update();
  EXPECT_LE(baked.baker->GetTexture()->GetDimensions()[0], 64);
  EXPECT_LE(baked.baker->GetTexture()->GetDimensions()[1], 64);
}

TEST(TextureAtlas, OneTooSmallForItsChartsIsAnError)
{
  BlockScene scene;
  std::vector<Photograph> photographs;
  for (int i = 0; i < 6; ++i)
  {
    photographs.push_back(scene.Take(scene.CameraAt(i), "p"));
  }
  const TriangleMesh mesh = scene.Mesh();
  const SurfaceColor color(mesh, photographs);
  TextureAtlasOptions options;
  options.largest = 16;
  options.gutter = 7; // a chart keeps sixteen texels square, however coarse they are
  EXPECT_THROW(BakeTexture(mesh, color, options), Error);
}

TEST(TextureBaker, WithoutPhotographsAllIsUnseen)
{
  BakedScene baked;
  baked.baker->SetPhotographs(nullptr);
  baked.baker->SetUnseenColor(0, 0, 1);
  baked.baker->Update();
  Eigen::Vector3d point;
  EXPECT_EQ(baked.Look(0, 0.3, 0.3, point), (std::array<double, 3>{ 0, 0, 255 }));
}

TEST(TextureBaker, EmptySurfaceIsAnError)
{
  ExpectedErrors errors;
  vtkNew<vtkTextureBaker> baker;
  baker->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  baker->Update();
  EXPECT_TRUE(errors.Has("There is no surface to texture."));
  EXPECT_EQ(baker->GetOutput()->GetNumberOfCells(), 0);
}

TEST(SurfaceColor, ExposuresAreLevelled)
{
  BlockScene scene;
  std::vector<Photograph> photographs;
  for (int i = 0; i < 6; ++i)
  {
    photographs.push_back(scene.Take(scene.CameraAt(i), "p"));
    for (unsigned char& value : photographs.back().rgb)
    {
      value = static_cast<unsigned char>(i % 2 ? 0.7 * value : value);
    }
  }
  TriangleMesh fine; // levelling compares the middles of triangles
  for (int i = 0; i < 40 * 40; ++i)
  {
    const Eigen::Vector3d corner(-5 + i % 40 * 0.25, -5 + i / 40 * 0.25, 0);
    const int first = static_cast<int>(fine.points.size());
    fine.points.push_back(corner);
    fine.points.push_back(corner + Eigen::Vector3d(0.25, 0, 0));
    fine.points.push_back(corner + Eigen::Vector3d(0, 0.25, 0));
    fine.triangles.push_back({ first, first + 1, first + 2 });
  }
  const TriangleMesh block = scene.Mesh();
  const int first = static_cast<int>(fine.points.size());
  fine.points.insert(fine.points.end(), block.points.begin(), block.points.end());
  for (const auto& [a, b, c] : block.triangles)
  {
    fine.triangles.push_back({ first + a, first + b, first + c });
  }
  const SurfaceColor color(fine, photographs);
  for (int channel = 1; channel < 3; ++channel)
  {
    EXPECT_NEAR(color.Gains()[1][channel] / color.Gains()[0][channel], 1 / 0.7, 0.03);
    EXPECT_NEAR(color.Gains()[4][channel] / color.Gains()[2][channel], 1, 0.03);
  }
}

TEST(TexturedSurfaceWriter, GLBLoadsInAnIndependentReader)
{
  const BakedScene baked;
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(baked, folder + "/model.glb"), 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName((folder + "/model.glb").c_str());
  reader->ApplyDeformationsToGeometryOff();
  reader->Update();
  auto* read = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  ASSERT_NE(read, nullptr);
  vtkPolyData* surface = nullptr;
  vtkDataObject* at = read;
  while (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(at))
  {
    ASSERT_GT(blocks->GetNumberOfBlocks(), 0u);
    at = blocks->GetBlock(0);
  }
  surface = vtkPolyData::SafeDownCast(at);
  ASSERT_NE(surface, nullptr);
  vtkPolyData* written = baked.baker->GetOutput();
  ASSERT_EQ(surface->GetNumberOfCells(), written->GetNumberOfCells());
  ASSERT_EQ(surface->GetNumberOfPoints(), written->GetNumberOfPoints());
  for (int axis = 0; axis < 6; ++axis)
  {
    EXPECT_NEAR(surface->GetBounds()[axis], written->GetBounds()[axis], 1e-5);
  }
  EXPECT_NE(surface->GetPointData()->GetTCoords(), nullptr);
  ASSERT_EQ(reader->GetNumberOfTextures(), 1);
  const auto texture = reader->GetGLTFTexture(0);
  ASSERT_NE(texture.Image, nullptr);
  EXPECT_EQ(texture.Image->GetDimensions()[0], baked.baker->GetTexture()->GetDimensions()[0]);
  EXPECT_EQ(texture.Image->GetDimensions()[1], baked.baker->GetTexture()->GetDimensions()[1]);
}

TEST(TexturedSurfaceWriter, OBJHasItsMaterialAndTextureBeside)
{
  const BakedScene baked;
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(baked, folder + "/model.obj"), 1);
  EXPECT_TRUE(fs::exists(folder + "/model.mtl"));
  ASSERT_TRUE(fs::exists(folder + "/model.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3);
  std::ifstream material(folder + "/model.mtl");
  const std::string lines((std::istreambuf_iterator<char>(material)), {});
  EXPECT_EQ(lines, "newmtl model\nmap_Kd model.png\n") << "the texture is named without a folder";
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName((folder + "/model.obj").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 12);
  EXPECT_NE(reader->GetOutput()->GetPointData()->GetTCoords(), nullptr);
  vtkNew<vtkPNGReader> png;
  png->SetFileName((folder + "/model.png").c_str());
  png->Update();
  EXPECT_EQ(png->GetOutput()->GetDimensions()[0], baked.baker->GetTexture()->GetDimensions()[0]);
}

TEST(TexturedSurfaceWriter, PLYHasTheColoursOfPoints)
{
  const BakedScene baked;
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  ASSERT_EQ(Write(baked, folder + "/model.ply"), 1);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((folder + "/model.ply").c_str());
  reader->Update();
  auto* colors =
    vtkUnsignedCharArray::SafeDownCast(reader->GetOutput()->GetPointData()->GetScalars());
  auto* written =
    vtkUnsignedCharArray::SafeDownCast(baked.baker->GetOutput()->GetPointData()->GetScalars());
  ASSERT_NE(colors, nullptr);
  ASSERT_EQ(colors->GetNumberOfTuples(), written->GetNumberOfTuples());
  for (vtkIdType i = 0; i < 3 * colors->GetNumberOfTuples(); ++i)
  {
    EXPECT_EQ(colors->GetValue(i), written->GetValue(i));
  }
}

TEST(TexturedSurfaceWriter, FaultsAreErrors)
{
  ExpectedErrors errors;
  const BakedScene baked(1);
  EXPECT_EQ(Write(baked, "/nowhere/at/all/model.glb"), 0);
  EXPECT_TRUE(errors.Has("/nowhere/at/all"));
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  EXPECT_EQ(Write(baked, folder + "/model.xyz"), 0);
  EXPECT_TRUE(errors.Has("model.xyz"));
  vtkNew<vtkTexturedSurfaceWriter> writer;
  writer->SetInputDataObject(0, baked.scene.Surface());
  writer->SetFileName(folder + "/model.glb");
  EXPECT_EQ(writer->Write(), 0) << "no texture";
  EXPECT_TRUE(errors.Has("no texture or no coordinates"));
  EXPECT_TRUE(fs::is_empty(folder));
}
