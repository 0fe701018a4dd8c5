// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographReader.h"

#include "Data/ViewBlocks.h"
#include "SparseModel/ColmapModel.h"
#include "Support/ErrorObserver.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

using namespace freespace;

namespace
{

// A scene of images of 8 x 6 pixels, of which some have a file.
struct SmallScene
{
  explicit SmallScene(const std::vector<std::string>& names, double distortion = 0)
  {
    SparseModel model;
    model.cameras.push_back({ 1, LensModel::SimpleRadial, 8, 6, { 10, 4, 3, distortion } });
    for (const std::string& name : names)
    {
      SparseImage& image = model.images.emplace_back();
      image.id = static_cast<std::uint32_t>(model.images.size());
      image.name = name;
      image.camera = 1;
      image.rotation = { 1, 0, 0, 0 };
      image.translation = { 0.5, 0, 0 };
    }
    WriteColmapModel(model, this->Folder.Path("sparse"), ColmapFormat::Text);
    this->File = this->Folder.Write("scene.json", R"({ "images": "images", "model": "sparse" })");
    std::filesystem::create_directories(this->Folder.Path("images"));
  }

  void WriteImage(const std::string& name, int width, int height)
  {
    cv::Mat image(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        image.at<cv::Vec3b>(y, x) = cv::Vec3b(10 * x, 20 * y, 100); // blue, green, red
      }
    }
    cv::imwrite(this->Folder.Path("images/" + name), image);
  }

  TemporaryFolder Folder;
  std::string File;
};

}

TEST(vtkPhotographReader, ImagesWithTheirCameras)
{
  SmallScene scene({ "a.png", "absent.png", "b.png" });
  scene.WriteImage("a.png", 8, 6);
  scene.WriteImage("b.png", 8, 6);
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.File);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 2u) << "an image without a file is left out";
  EXPECT_EQ(BlockName(reader->GetOutput(), 0), "a.png");
  EXPECT_EQ(BlockName(reader->GetOutput(), 1), "b.png");
  auto* image = vtkImageData::SafeDownCast(reader->GetOutput()->GetBlock(1));
  ASSERT_TRUE(image);
  const int* size = image->GetDimensions();
  ASSERT_EQ(size[0], 8);
  ASSERT_EQ(size[1], 6);
  for (int y = 0; y < 6; ++y)
  {
    for (int x = 0; x < 8; ++x)
    {
      // VTK's rows go up.
      const auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, 5 - y, 0));
      EXPECT_EQ(pixel[0], 100);
      EXPECT_EQ(pixel[1], 20 * y);
      EXPECT_EQ(pixel[2], 10 * x);
    }
  }
  const Camera camera = CameraFromBlock(image, "b.png");
  EXPECT_EQ(camera.K, (Eigen::Matrix3d() << 10, 0, 4, 0, 10, 3, 0, 0, 1).finished());
  EXPECT_EQ(camera.t, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_EQ(camera.width, 8);
  EXPECT_EQ(camera.height, 6);
}

TEST(vtkPhotographReader, DistortionIsTakenOut)
{
  SmallScene scene({ "a.png" }, 0.5);
  scene.WriteImage("a.png", 8, 6);
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.File);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  auto* image = vtkImageData::SafeDownCast(reader->GetOutput()->GetBlock(0));
  ASSERT_TRUE(image);
  for (int x = 2; x < 6; ++x)
  {
    // The pixel's centre, normalized, is shown where the lens puts it; blue is linear in x.
    const Eigen::Vector2d point((x + 0.5 - 4) / 10, (3 + 0.5 - 3) / 10);
    const double u = 10 * point.x() * (1 + 0.5 * point.squaredNorm()) + 4 - 0.5;
    const auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, 5 - 3, 0));
    EXPECT_NEAR(pixel[2], 10 * u, 1) << x;
  }
}

TEST(vtkPhotographReader, AnImageOfAnotherSizeIsAnErrorThatNamesIt)
{
  SmallScene scene({ "a.png", "b.png" });
  scene.WriteImage("a.png", 8, 6);
  scene.WriteImage("b.png", 9, 6);
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.File);
  const std::string error = ErrorOfUpdate(reader);
  EXPECT_NE(error.find("b.png"), std::string::npos) << error;
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(vtkPhotographReader, ADamagedImageIsAnErrorThatNamesIt)
{
  SmallScene scene({ "a.png" });
  scene.Folder.Write("images/a.png", "no image");
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.File);
  const std::string error = ErrorOfUpdate(reader);
  EXPECT_NE(error.find("a.png"), std::string::npos) << error;
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(vtkPhotographReader, ASceneWithoutAnyImageIsAnError)
{
  SmallScene scene({ "a.png" });
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.File);
  const std::string error = ErrorOfUpdate(reader);
  EXPECT_NE(error.find("has no image in"), std::string::npos) << error;
  reader->SetFileName("/no/such/scene.json");
  EXPECT_NE(ErrorOfUpdate(reader).find("/no/such/scene.json"), std::string::npos);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
}
