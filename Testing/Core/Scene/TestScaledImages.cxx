// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ScaledImages.h"

#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

class SizedPhotographs
{
public:
  SizedPhotographs()
  {
    std::filesystem::create_directories(this->Folder.Path("images"));
    this->Scene.file = this->Folder.Path("scene.json");
    this->Scene.images = "images";
  }

  void Add(const std::string& name, int width, int height) const
  {
    cv::imwrite(this->Folder.Path("images/" + name), cv::Mat(height, width, CV_8UC3, { 9, 9, 9 }));
  }

  TemporaryFolder Folder;
  freespace::Scene Scene;
};

}

TEST(ScaledImages, CamerasAndObservationsFollowThePhotographs)
{
  SparseModel model = MakeSyntheticModel(3, 50, LensModel::Radial);
  const SparseModel given = model;
  const SizedPhotographs photographs; // of 800 x 600
  photographs.Add("image0.jpg", 400, 300);
  photographs.Add("image1.jpg", 800, 600);
  const std::string told = ScaleToPhotographs(photographs.Scene, model);
  EXPECT_EQ(told, "1 of 3 images have another size than their cameras, which are scaled by 0.5");
  const auto before = CalibratedImages(given), after = CalibratedImages(model);
  EXPECT_EQ(after[0].camera.width, 400);
  EXPECT_EQ(after[0].camera.height, 300);
  EXPECT_EQ(after[0].distortion, before[0].distortion);
  EXPECT_EQ(after[1].camera.K, before[1].camera.K);
  EXPECT_EQ(after[2].camera.K, before[2].camera.K); // whose file is missing
  for (std::size_t i = 0; i < given.images[0].observations.size(); ++i)
  {
    EXPECT_EQ(model.images[0].observations[i].pixel, 0.5 * given.images[0].observations[i].pixel);
  }
  for (const SparsePoint& point : model.points)
  {
    EXPECT_LT(
      (ShowPoint(model, 0, point.position) - 0.5 * ShowPoint(given, 0, point.position)).norm(),
      1e-9);
  }
}

TEST(ScaledImages, RoundedSizesAreScaledAndOthersLeft)
{
  const SizedPhotographs photographs;
  SparseModel model = MakeSyntheticModel(3, 10);
  photographs.Add("image0.jpg", 267, 200); // 266.67
  photographs.Add("image1.jpg", 600, 800); // turned
  photographs.Add("image2.jpg", 800, 500); // cut
  EXPECT_EQ(ScaleToPhotographs(photographs.Scene, model).rfind("1 of 3", 0), 0u);
  const auto images = CalibratedImages(model);
  EXPECT_EQ(images[0].camera.width, 267);
  EXPECT_NEAR(images[0].camera.K(0, 0), 700 * 267 / 800.0, 1e-9);
  EXPECT_NEAR(images[0].camera.K(1, 1), 710 * 200 / 600.0, 1e-9);
  EXPECT_EQ(images[1].camera.width, 800);
  EXPECT_EQ(images[2].camera.height, 600);
}
