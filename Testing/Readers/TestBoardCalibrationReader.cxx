// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBoardCalibration.h"
#include "vtkSparseModelWriter.h"

#include "SparseModel/ColmapModel.h"
#include "Support/ErrorObserver.h"
#include "Support/SharedData.h"
#include "Support/TemporaryFolder.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace freespace;

namespace
{

void AddImages(
  vtkBoardCalibration* calibration, const std::string& folder, const std::string& begin)
{
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (name.rfind(begin, 0) == 0 && entry.path().extension() == ".jpg")
    {
      calibration->AddFileName(entry.path().string());
    }
  }
}

// The largest distance of corresponding points after the best rigid motion.
double LargestDistanceAfterAlignment(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to)
{
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd moved =
    (motion.topLeftCorner<3, 3>() * from).colwise() + motion.topRightCorner<3, 1>().eval();
  return (moved - to).colwise().norm().maxCoeff();
}

}

TEST(BoardCalibrationOfSharedData, Charuco)
{
  const std::string data = SharedData("charuco");
  if (data.empty())
  {
    GTEST_SKIP() << "no shared data";
  }
  vtkNew<vtkBoardCalibration> calibration;
  calibration->SetBoard("charuco:15x15:0.03:0.0225:DICT_5X5_250");
  AddImages(calibration, data + "/images", "cluster");
  TemporaryFolder folder;
  vtkNew<vtkSparseModelWriter> writer;
  writer->SetInputConnection(calibration->GetOutputPort());
  writer->SetFileName(folder.Path("model"));
  ASSERT_EQ(writer->Write(), 1);
  std::map<std::string, Camera> truth;
  for (const CalibratedImage& image : CalibratedImages(ReadColmapModel(data + "/sparse")))
  {
    truth[image.file] = image.camera;
  }
  const auto images = CalibratedImages(ReadColmapModel(folder.Path("model")));
  ASSERT_EQ(images.size(), truth.size());
  Eigen::Matrix3Xd found(3, images.size()), expected(3, images.size());
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const Camera& camera = truth.at(images[i].file);
    EXPECT_NEAR(images[i].camera.K(0, 0) / camera.K(0, 0), 1, 0.002);
    EXPECT_NEAR(images[i].camera.K(0, 2), camera.K(0, 2), 2);
    EXPECT_NEAR(images[i].camera.K(1, 2), camera.K(1, 2), 2);
    found.col(i) = images[i].camera.Center();
    expected.col(i) = camera.Center();
  }
  EXPECT_LT(LargestDistanceAfterAlignment(found, expected), 0.001);
  EXPECT_LT(calibration->GetReprojectionError(), 0.1);
}

TEST(BoardCalibrationOfSharedData, Chessboard)
{
  const std::string data = SharedData("chessboard");
  if (data.empty())
  {
    GTEST_SKIP() << "no shared data";
  }
  for (const std::string side : { "left", "right" })
  {
    vtkNew<vtkBoardCalibration> calibration;
    calibration->SetBoard("chessboard:9x6:0.025");
    AddImages(calibration, data, side);
    ASSERT_EQ(calibration->GetNumberOfFileNames(), 13);
    TemporaryFolder folder;
    vtkNew<vtkSparseModelWriter> writer;
    writer->SetInputConnection(calibration->GetOutputPort());
    writer->SetFileName(folder.Path("model"));
    ASSERT_EQ(writer->Write(), 1);
    const auto images = CalibratedImages(ReadColmapModel(folder.Path("model")));
    ASSERT_EQ(images.size(), 13u);
    EXPECT_NEAR(images[0].camera.K(0, 0) / 534.80, 1, 0.005) << "intrinsics.yml";
    if (side == "left")
    {
      EXPECT_NEAR(images[0].camera.K(0, 0) / 535.916, 1, 0.005) << "left_intrinsics.yml";
    }
  }
}

TEST(BoardCalibrationReader, BadInput)
{
  ExpectedErrors errors;
  vtkNew<vtkBoardCalibration> calibration;
  calibration->Update();
  EXPECT_EQ(calibration->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(errors.Has("There are no images to calibrate from."));
  calibration->AddFileName("/no/such/image.png");
  calibration->SetBoard("chessboard:9x6:0.025");
  calibration->Update();
  EXPECT_EQ(calibration->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(errors.Has("/no/such/image.png"));
  calibration->SetBoard("dots:9x6");
  calibration->Update();
  EXPECT_EQ(calibration->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(errors.Has("dots:9x6"));
  EXPECT_EQ(calibration->GetText(), "");
  TemporaryFolder folder;
  EXPECT_EQ(calibration->WriteScene(folder.Path("scene.json"), folder.Path("model")), 0);
  EXPECT_TRUE(errors.Has("nothing was calibrated"));
  calibration->ClearFileNames();
  EXPECT_EQ(calibration->GetNumberOfFileNames(), 0);
}
