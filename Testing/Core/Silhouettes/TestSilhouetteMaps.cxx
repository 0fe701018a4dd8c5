// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes/SilhouetteMaps.h"

#include "Common/Error.h"
#include "Freespace/FreespaceUnion.h"
#include "Images/LensDistortion.h"
#include "Support/RandomMaps.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// Cameras around a ball of radius 0.5 at the origin, and their masks: white where the ball is.
struct Turntable
{
  explicit Turntable(std::vector<double> distortion = {})
  {
    this->Scene.file = this->Folder.Path("scene.json");
    this->Scene.masks = "masks";
    std::filesystem::create_directories(this->Folder.Path("masks"));
    for (int i = 0; i < 6; ++i)
    {
      CalibratedImage image;
      image.file = "image" + std::to_string(i) + ".png";
      const double angle = 2 * M_PI * i / 6;
      image.camera = LookingAt(3 * Vector3d(std::cos(angle), std::sin(angle), 0), Vector3d::Zero());
      image.distortion = distortion;
      this->Images.push_back(image);
      this->WriteMask(image);
    }
    EdgeView view;
    view.camera = this->Images[0].camera;
    for (const double x : { -0.5, 0.5 })
    {
      view.points.emplace_back(x, x, x);
    }
    this->Views.push_back(view);
  }

  static bool ShowsBall(const Camera& camera, const Vector2d& pixel)
  {
    const Vector3d ray = camera.Ray(pixel).normalized();
    return camera.Center().cross(ray).norm() < 0.5;
  }

  void WriteMask(const CalibratedImage& image)
  {
    const Camera& camera = image.camera;
    cv::Mat mask(camera.height, camera.width, CV_8U);
    for (int row = 0; row < camera.height; ++row)
    {
      for (int column = 0; column < camera.width; ++column)
      {
        const Vector2d pixel =
          UndistortPixels(image, { Vector2d(column + 0.5, row + 0.5) }).front();
        mask.at<unsigned char>(row, column) = ShowsBall(camera, pixel) ? 255 : 0;
      }
    }
    cv::imwrite(this->Folder.Path("masks/" + image.file + ".png"), mask);
  }

  std::vector<DisparityMap> Maps() const
  {
    return SilhouetteMaps(this->Scene, this->Images, this->Views, SerialFor, Progress());
  }

  TemporaryFolder Folder;
  freespace::Scene Scene;
  std::vector<CalibratedImage> Images;
  std::vector<EdgeView> Views;
};

// A cube of features, each seen by one camera from far above: matter, as far as the silhouettes do not carve it.
DisparityMap Lid()
{
  DisparityMap map;
  map.name = "lid";
  map.camera = LookingAt(Vector3d(0, 0, 9), Vector3d::Zero());
  for (const double z : { -1.0, 1.0 })
  {
    for (const double x : { -1.0, 1.0 })
    {
      for (const double y : { -1.0, 1.0 })
      {
        map.points.emplace_back(x, y, z);
        map.imagePoints.push_back(map.camera.Project(map.points.back()));
        map.sourceView.push_back(0);
      }
    }
  }
  return map;
}

}

TEST(SilhouetteMaps, LieBehindAllFeaturesAndHaveNone)
{
  const Turntable turntable;
  const auto maps = turntable.Maps();
  ASSERT_EQ(maps.size(), 6u);
  EXPECT_EQ(maps[2].name, "image2.png (mask)");
  EXPECT_EQ(maps[2].imageFile, "image2.png");
  for (const DisparityMap& map : maps)
  {
    ASSERT_EQ(map.points.size(), map.imagePoints.size());
    for (std::size_t i = 0; i < map.points.size(); ++i)
    {
      ASSERT_GT(map.camera.Depth(map.points[i]), 2 * 3);
      ASSERT_LT((map.camera.Project(map.points[i]) - map.imagePoints[i]).norm(), 1e-9);
      ASSERT_EQ(map.sourceView[i], -1);
    }
  }
}

// The union is free wherever a mask shows it by more than two pixels, and matter where none does, whatever other views
// would have: the visual hull.
TEST(SilhouetteMaps, UnionIsTheComplementOfTheVisualHull)
{
  for (const auto& distortion : { std::vector<double>(), std::vector<double>{ 0.1, -0.05, 0, 0 } })
  {
    const Turntable turntable(distortion);
    std::vector<DisparityMap> maps = { Lid() };
    for (const DisparityMap& map : turntable.Maps())
    {
      maps.push_back(map);
    }
    for (const int views : { FreespaceUnionOptions::AutomaticViews, 1, 2, 7 })
    {
      FreespaceUnionOptions options;
      options.minimumViews = views;
      options.surroundings = 0;
      const FreespaceUnion phi(maps, options);
      EXPECT_EQ(phi.NumberOfViews(), maps.size());
      std::mt19937 random(7);
      std::uniform_real_distribution<double> uniform(-1, 1);
      int free = 0, matter = 0;
      for (int i = 0; i < 4000; ++i)
      {
        const Vector3d point(uniform(random), uniform(random), uniform(random));
        bool isClearlySeen = false, mayBeSeen = false;
        for (const CalibratedImage& image : turntable.Images)
        {
          const Camera& camera = image.camera;
          const Vector3d ray = (point - camera.Center()).normalized();
          const double pixels =
            (camera.Center().cross(ray).norm() - 0.5) / 3 * camera.FocalLength();
          const Vector2d pixel = camera.Project(point);
          const bool isInside = pixel.x() > 8 && pixel.y() > 8 && pixel.x() < camera.width - 8 &&
            pixel.y() < camera.height - 8;
          isClearlySeen = isClearlySeen || (isInside && pixels > 3);
          mayBeSeen = mayBeSeen || pixels > 0;
        }
        if (isClearlySeen || !mayBeSeen)
        {
          ASSERT_EQ(phi.IsFree(point), isClearlySeen) << point.transpose();
          (isClearlySeen ? free : matter) += 1;
        }
      }
      EXPECT_GT(free, 1000);
      EXPECT_GT(matter, 200);
    }
  }
}

TEST(SilhouetteMaps, NeedMasksAndFeatures)
{
  Turntable turntable;
  std::filesystem::remove(turntable.Folder.Path("masks/image1.png.png"));
  cv::imwrite(
    turntable.Folder.Path("masks/image2.png.png"), cv::Mat(80, 100, CV_8U, cv::Scalar(255)));
  EXPECT_EQ(turntable.Maps().size(), 4u) << "without a mask, and without black";
  turntable.Folder.Write("masks/image3.png.png", "no image");
  EXPECT_THROW(turntable.Maps(), Error);
  turntable.Views.clear();
  turntable.Folder.Write("masks/image3.png.png", "");
  std::filesystem::remove(turntable.Folder.Path("masks/image3.png.png"));
  EXPECT_TRUE(turntable.Maps().empty());
}
