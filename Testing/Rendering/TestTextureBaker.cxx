// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTextureBaker.h"

#include "Support/Scenes/BakedScene.h"
#include "Support/ErrorObserver.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

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
