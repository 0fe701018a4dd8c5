// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewDependentTextureMapper.h"

#include "Support/ErrorObserver.h"
#include "Support/Scenes/BlockScene.h"
#include "Support/PictureComparison.h"
#include "vtkSurfacePicture.h"

#include <vtkTriangleFilter.h>
#include <vtkLinearSubdivisionFilter.h>

#include <functional>
#include <set>

using namespace freespace;

namespace
{

// The scene from a camera with the mapper, and what the picture should be.
struct Comparison
{
  BlockScene scene;
  Camera camera;
  vtkNew<vtkViewDependentTextureMapper> mapper;
  vtkNew<vtkSurfacePicture> picture;

  Comparison(const BlockScene& shown, const Camera& from, int photographs)
    : scene(shown)
    , camera(from)
  {
    this->mapper->SetPhotographs(this->scene.Photographs(photographs));
    this->picture->SetInputData(this->scene.Surface());
    this->picture->SetMapper(this->mapper);
    this->picture->SetSamples(1);
  }

  void Render()
  {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> intrinsics = this->camera.K;
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> pose;
    pose << this->camera.R, this->camera.t;
    const int size[2] = { this->camera.width, this->camera.height };
    this->picture->SetView(intrinsics.data(), pose.data(), size);
    this->picture->Update();
    this->Seen = RenderDisparity(this->scene.Mesh(), this->camera);
  }

  // Calls with the true point and the shown colour, for pixels `inside` pixels from any edge.
  void ForEachPixel(int inside,
    const std::function<void(const Eigen::Vector3d&, const unsigned char*)>& visit) const
  {
    for (int row = inside; row + inside < this->camera.height; ++row)
    {
      for (int column = inside; column + inside < this->camera.width; ++column)
      {
        bool same = true;
        const bool block = this->IsOnBlock(column, row);
        for (int v = row - inside; v <= row + inside && same; ++v)
        {
          for (int u = column - inside; u <= column + inside && same; ++u)
          {
            same = this->Seen.At(u, v) > 0 && this->IsOnBlock(u, v) == block;
          }
        }
        if (same)
        {
          visit(this->PointAt(column, row),
            static_cast<const unsigned char*>(this->picture->GetOutput()->GetScalarPointer(
              column, this->camera.height - 1 - row, 0)));
        }
      }
    }
  }

  Eigen::Vector3d PointAt(int column, int row) const
  {
    return this->camera.Unproject({ column + 0.5, row + 0.5 }, 1 / this->Seen.At(column, row));
  }

  bool IsOnBlock(int column, int row) const
  {
    return this->scene.IsOnBlock(this->PointAt(column, row));
  }

  double MeanError(int inside) const
  {
    double sum = 0;
    int count = 0;
    this->ForEachPixel(inside,
      [&](const Eigen::Vector3d& point, const unsigned char* shown)
      {
        const std::array<double, 3> expected = this->scene.ColorAt(point);
        for (int channel = 0; channel < 3; ++channel)
        {
          sum += std::abs(expected[channel] - shown[channel]) / 3;
        }
        ++count;
      });
    EXPECT_GT(count, 10000);
    return sum / count;
  }

  DisparityImage Seen;
};

}

TEST(ViewDependentTexture, NovelViewHasTheColoursOfTheSurface)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.4, 8, 6), 8);
  comparison.Render();
  EXPECT_LT(comparison.MeanError(1), 2.0);
  EXPECT_EQ(comparison.mapper->GetNumberOfViewsInUse(), 8);
  ExpectBaseline(comparison.picture->GetOutput(), "ViewDependentTexture");
}

TEST(ViewDependentTexture, CoordinatesMayBeLarge)
{
  BlockScene scene;
  scene.offset = { 431000, 5412000, 300 };
  Comparison comparison(scene, scene.CameraAt(0.4, 8, 6), 8);
  comparison.Render();
  EXPECT_LT(comparison.MeanError(2), 2.0);
}

// The mask's very purpose: each camera sees the block before a part of the board.
TEST(ViewDependentTexture, NothingOfABlockAppearsOnTheBoardBehindIt)
{
  for (const int photographs : { 1, 2, 3, 8 })
  {
    for (const double angle : { 0.0, 0.6, 2.0, 4.0 })
    {
      Comparison comparison(BlockScene(), BlockScene().CameraAt(angle, 7, 9), photographs);
      comparison.mapper->SetUnseenColor(0, 0, 1);
      comparison.Render();
      int reddest = 0;
      int count = 0;
      comparison.ForEachPixel(1,
        [&](const Eigen::Vector3d& point, const unsigned char* shown)
        {
          // Where the block stands on the board, and at the board's rim, a pixel of an image,
          // 0.1 long there, shows both.
          const double beside = std::max(std::abs(point.x()), std::abs(point.y())) - 1;
          if (!comparison.scene.IsOnBlock(point) && beside > 0.2 && beside < 3.8)
          {
            reddest = std::max(reddest, int(shown[0]));
            ++count;
          }
        });
      EXPECT_GT(count, 5000);
      EXPECT_LE(reddest, 10) << photographs << " images, from " << angle;
    }
  }
}

TEST(ViewDependentTexture, WhatNoPhotographSeesHasTheUnseenColor)
{
  // One image from +x: the block's face towards -x and the board behind it are not seen.
  Comparison comparison(BlockScene(), BlockScene().CameraAt(M_PI, 9, 7), 1);
  comparison.mapper->SetUnseenColor(0.2, 0.4, 0.6);
  comparison.Render();
  int faceSeen = 0;
  comparison.ForEachPixel(1,
    [&](const Eigen::Vector3d& point, const unsigned char* shown)
    {
      const bool onFace = point.x() < -0.999 && point.z() > 0.1 && point.z() < 1.9;
      const bool behind = point.x() < -1.1 && point.x() > -1.5 && std::abs(point.y()) < 0.5;
      if (onFace || behind)
      {
        EXPECT_NEAR(shown[0], 51, 1);
        EXPECT_NEAR(shown[1], 102, 1);
        EXPECT_NEAR(shown[2], 153, 1);
        ++faceSeen;
      }
    });
  EXPECT_GT(faceSeen, 500);
}

TEST(ViewDependentTexture, FineMeshLooksLikeACoarseOne)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.4, 8, 6), 8);
  comparison.Render();
  vtkNew<vtkImageData> coarse;
  coarse->DeepCopy(comparison.picture->GetOutput());
  vtkNew<vtkLinearSubdivisionFilter> fine;
  fine->SetInputData(comparison.scene.Surface());
  fine->SetNumberOfSubdivisions(5);
  comparison.picture->SetInputConnection(fine->GetOutputPort());
  comparison.Render();
  const PictureDifference difference = ComparePictures(coarse, comparison.picture->GetOutput());
  EXPECT_LT(difference.mean, 0.3);
  EXPECT_LT(difference.share, 0.01);
}

TEST(ViewDependentTexture, TheBestViewsAreChosenWhereNotAllFit)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.0, 8, 6), 8);
  comparison.mapper->SetMaximumNumberOfViews(3);
  comparison.Render();
  std::set<std::string> inUse;
  for (int i = 0; i < comparison.mapper->GetNumberOfViewsInUse(); ++i)
  {
    inUse.insert(comparison.mapper->GetViewInUse(i));
  }
  EXPECT_EQ(inUse, (std::set<std::string>{ "p0", "p1", "p7" }));
  comparison.camera = comparison.scene.CameraAt(M_PI, 8, 6);
  comparison.Render();
  inUse.clear();
  for (int i = 0; i < comparison.mapper->GetNumberOfViewsInUse(); ++i)
  {
    inUse.insert(comparison.mapper->GetViewInUse(i));
  }
  EXPECT_EQ(inUse, (std::set<std::string>{ "p3", "p4", "p5" }));
  EXPECT_EQ(comparison.mapper->GetViewInUse(3), "");
}

TEST(ViewDependentTexture, MemoryLimitsTheViews)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.0, 8, 6), 8);
  comparison.mapper->SetTextureMemory(2);
  comparison.Render();
  EXPECT_EQ(comparison.mapper->GetNumberOfViewsInUse(), 3);
}

TEST(ViewDependentTexture, LargePhotographsAreReduced)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.4, 8, 6), 8);
  comparison.mapper->SetMaximumPhotographSize(120);
  comparison.Render();
  EXPECT_LT(comparison.MeanError(2), 6.0);
}

TEST(ViewDependentTexture, WithoutPhotographsAllIsUnseen)
{
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.4), 1);
  comparison.mapper->SetPhotographs(nullptr);
  comparison.mapper->SetUnseenColor(0, 1, 0);
  comparison.Render();
  comparison.ForEachPixel(1,
    [&](const Eigen::Vector3d&, const unsigned char* shown)
    {
      EXPECT_EQ(shown[0], 0);
      EXPECT_EQ(shown[1], 255);
    });
}

TEST(ViewDependentTexture, RefusesABlockThatIsNoPhotograph)
{
  ExpectedErrors errors;
  Comparison comparison(BlockScene(), BlockScene().CameraAt(0.4), 2);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->ShallowCopy(comparison.mapper->GetPhotographs());
  blocks->SetBlock(1, vtkSmartPointer<vtkPolyData>::New());
  comparison.mapper->SetPhotographs(blocks);
  comparison.Render();
  EXPECT_TRUE(errors.Has("'p1' is not an image"));
  EXPECT_EQ(comparison.mapper->GetNumberOfViewsInUse(), 0);
}
