// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTexturedSurfaceWriter.h"

#include "Support/Scenes/BakedScene.h"
#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"

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

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

int Write(const BakedScene& baked, const std::string& fileName)
{
  vtkNew<vtkTexturedSurfaceWriter> writer;
  writer->SetInputDataObject(0, baked.baker->GetOutput());
  writer->SetInputDataObject(1, baked.baker->GetTexture());
  writer->SetFileName(fileName);
  return writer->Write();
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
