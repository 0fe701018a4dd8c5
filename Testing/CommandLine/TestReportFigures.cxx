// SPDX-License-Identifier: BSD-3-Clause
// What a report shows of a block on a board, each picture as the file that the report leaves.
#include "Report/ReportFigures.h"

#include "Scene/Scene.h"
#include "Session/Session.h"
#include "Support/Scenes/BlockFeatures.h"
#include "Support/PictureComparison.h"
#include "Support/TemporaryFolder.h"

#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

using namespace freespace;

namespace
{

std::vector<Camera> OneCamera()
{
  return { BlockScene().CameraAt(0.4) };
}

vtkSmartPointer<vtkImageData> ReadPng(const std::string& file)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

// The mean colour of the pixels within 2 of where the camera sees a point.
std::array<double, 3> ColorAt(
  vtkImageData* image, const Camera& camera, const Eigen::Vector3d& point)
{
  const Eigen::Vector2d pixel = camera.Project(point);
  std::array<double, 3> sum = { 0, 0, 0 };
  for (int i = 0; i < 25; ++i)
  {
    const auto* rgb = static_cast<const unsigned char*>(
      image->GetScalarPointer(static_cast<int>(pixel.x()) + i % 5 - 2,
        camera.height - 1 - static_cast<int>(pixel.y()) + i / 5 - 2, 0));
    for (int channel = 0; channel < 3; ++channel)
    {
      sum[channel] += rgb[channel] / 25.0;
    }
  }
  return sum;
}

}

TEST(ReportFigures, FeaturesOverTheImages)
{
  const TemporaryFolder folder;
  const auto photographs = BlockScene().Photographs(BlockCameras);
  for (const int i : { 0, 1, 3 }) // the others' files are missing
  {
    vtkNew<vtkPNGWriter> png;
    png->SetInputData(vtkImageData::SafeDownCast(photographs->GetBlock(i)));
    png->SetFileName(folder.Path("p" + std::to_string(i) + ".png").c_str());
    png->Write();
  }
  Scene scene;
  scene.file = folder.Path("scene.json");
  scene.images = ".";
  Session session;
  const auto figures = FeatureFigures(session, scene, BlockFeatures(), folder.Path(), 2);
  ASSERT_EQ(figures.size(), 2u) << "of three images two, evenly picked";
  EXPECT_EQ(figures[0].name, "v0");
  EXPECT_EQ(figures[1].name, "v1");
  ExpectBaseline(ReadPng(folder.Path("v0.png")), "FeatureOverlay");
}

TEST(ReportFigures, CloudOfTheFeatures)
{
  const TemporaryFolder folder;
  const auto features = BlockFeatures();
  vtkIdType count = 0;
  for (unsigned int i = 0; i < features->GetNumberOfBlocks(); ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(features->GetBlock(i));
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("RGB");
    colors->SetNumberOfComponents(3);
    for (vtkIdType k = 0; k < view->GetNumberOfPoints(); ++k)
    {
      const auto rgb = BlockScene().ColorAt(Eigen::Vector3d(view->GetPoint(k)));
      colors->InsertNextTuple(rgb.data());
    }
    view->GetPointData()->AddArray(colors);
    count += view->GetNumberOfPoints();
  }
  Session session;
  const auto figures = CloudFigures(session, features, OneCamera(), folder.Path());
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].alt.find(std::to_string(count / 1000)), 0u) << figures[0].alt;
  const auto image = ReadPng(folder.Path("featuresa.png"));
  // A feature is a pixel in its colour, brightened; beside it is the dark background.
  const Camera camera = OneCamera()[0];
  const auto on = ColorAt(image, camera, { 0, 0, 2 });
  EXPECT_GT(on[0], on[1] + 3) << "the block is red";
  EXPECT_LT(on[1], 60) << "of 25 pixels few are features";
  ExpectBaseline(image, "ReportFeatures");
}

TEST(ReportFigures, SurfaceInGreyAndInTheColoursOfTheImages)
{
  const TemporaryFolder folder;
  const BlockScene scene;
  const Camera camera = OneCamera()[0];
  Session session;
  ASSERT_EQ(SurfaceFigures(session, scene.Surface(), { camera }, folder.Path()).size(), 1u);
  const auto grey = ReadPng(folder.Path("surfacea.png"));
  const auto top = ColorAt(grey, camera, { 0, 0, 2 }), board = ColorAt(grey, camera, { 3, 2, 0 });
  EXPECT_EQ(grey->GetDimensions()[0], camera.width);
  EXPECT_EQ(grey->GetDimensions()[1], camera.height);
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(top[channel], board[channel], 1) << "of one direction, so of one brightness";
  }
  ExpectBaseline(grey, "ReportSurface");
  ASSERT_EQ(TexturedFigures(
              session, scene.Surface(), scene.Photographs(BlockCameras), { camera }, folder.Path())
              .size(),
    1u);
  const auto textured = ReadPng(folder.Path("textureda.png"));
  for (const Eigen::Vector3d& point :
    { Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(3, 2, 0), Eigen::Vector3d(-2, 3, 0) })
  {
    const auto seen = ColorAt(textured, camera, point), truth = scene.ColorAt(point);
    for (int channel = 0; channel < 3; ++channel)
    {
      EXPECT_NEAR(seen[channel], truth[channel], 12) << point.transpose();
    }
  }
  ExpectBaseline(textured, "ReportTextured");
}
