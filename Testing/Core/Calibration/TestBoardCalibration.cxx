// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardCalibration.h"
#include "Calibration/BoardImages.h"
#include "Calibration/BoardText.h"

#include "Common/Error.h"
#include "Support/BoardRendering.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>

using namespace freespace;

namespace
{

std::vector<CalibratedImage> Cameras(const std::vector<double>& distortion)
{
  std::vector<CalibratedImage> cameras = { BoardCamera(2, 3, 8, 0.32), BoardCamera(35, 5, 13, 0.3),
    BoardCamera(-35, -4, 80, 0.3), BoardCamera(3, 38, 15, 0.3), BoardCamera(-3, -38, -14, 0.32),
    BoardCamera(25, 25, 40, 0.3) };
  for (CalibratedImage& camera : cameras)
  {
    camera.distortion = distortion;
  }
  return cameras;
}

// Writes what the cameras see of the board and returns the names of the files.
std::vector<std::string> RenderAll(const TemporaryFolder& folder, const std::string& board,
  const std::vector<CalibratedImage>& cameras, bool hidePart, bool hasFormerLayout = false,
  const std::string& subfolder = "")
{
  const BoardRendering rendering(BoardFromText(board), hasFormerLayout);
  std::filesystem::create_directories(folder.Path(subfolder));
  std::vector<std::string> files;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    cv::Mat image = rendering.Render(cameras[i]);
    cv::Mat noise(image.size(), CV_16S);
    cv::theRNG().state = 5 + i;
    cv::randn(noise, 0, 2);
    cv::add(image, noise, image, cv::noArray(), CV_8U);
    if (hidePart)
    {
      cv::rectangle(image, { 180 + 10 * static_cast<int>(i), 120, 90, 110 }, { 90 }, cv::FILLED);
    }
    files.push_back(folder.Path(subfolder + "image" + std::to_string(i) + ".png"));
    cv::imwrite(files.back(), image);
  }
  return files;
}

BoardCalibration Calibrate(const std::vector<std::string>& files, const std::string& board)
{
  BoardCalibrationOptions options;
  options.board = BoardFromText(board);
  return CalibrateFromBoard(files, options);
}

void ExpectCameras(const BoardCalibration& calibration, const std::vector<CalibratedImage>& truth)
{
  ASSERT_EQ(calibration.images.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const BoardImage& image = calibration.images[i];
    ASSERT_TRUE(image.used) << image.reason;
    const Camera& camera = image.calibrated.camera;
    EXPECT_NEAR(camera.K(0, 0) / 560, 1, 0.002);
    EXPECT_NEAR(camera.K(1, 1) / 560, 1, 0.002);
    EXPECT_NEAR(camera.K(0, 2), 246.5, 1);
    EXPECT_NEAR(camera.K(1, 2), 176, 1);
    EXPECT_LT((camera.Center() - truth[i].camera.Center()).norm(), 0.001);
    EXPECT_LT(image.error, 0.1);
  }
}

}

TEST(BoardCalibration, CharucoThatIsPartlyHidden)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({});
  const BoardCalibration calibration =
    Calibrate(RenderAll(folder, charucoBoard, truth, true), charucoBoard);
  ExpectCameras(calibration, truth);
  EXPECT_TRUE(calibration.images[0].calibrated.distortion.empty()) << "there is none";
  EXPECT_LT(calibration.error, 0.08);
}

TEST(BoardCalibration, DistortionIsFound)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({ -0.2, 0.05, 0, 0 });
  const BoardCalibration calibration =
    Calibrate(RenderAll(folder, charucoBoard, truth, false), charucoBoard);
  ExpectCameras(calibration, truth);
  const std::vector<double>& distortion = calibration.images[0].calibrated.distortion;
  ASSERT_GE(distortion.size(), 4u);
  // At the edge of the image, where it counts.
  const double r2 = 0.25;
  EXPECT_NEAR(distortion[0] * r2 + distortion[1] * r2 * r2, -0.2 * r2 + 0.05 * r2 * r2, 0.003);
}

TEST(BoardCalibration, Chessboard)
{
  TemporaryFolder folder;
  std::vector<CalibratedImage> truth = Cameras({});
  for (CalibratedImage& camera : truth)
  {
    camera.camera.t.z() *= 1.4; // all of it must be seen
  }
  const BoardCalibration calibration =
    Calibrate(RenderAll(folder, chessboardBoard, truth, false), chessboardBoard);
  ASSERT_EQ(calibration.images.size(), truth.size());
  for (const BoardImage& image : calibration.images)
  {
    ASSERT_TRUE(image.used) << image.reason;
    EXPECT_GE(image.corners.ids.size(), 40u) << "of 7 x 6; an outlier may be dropped";
    EXPECT_NEAR(image.calibrated.camera.K(0, 0) / 560, 1, 0.002);
  }
}

TEST(BoardCalibration, ChessboardThatLooksTheSameTurned)
{
  for (const char* board : { "chessboard:8x6:0.03", "chessboard:7x7:0.03", "chessboard:7x5:0.03" })
  {
    ExpectError([&]() { Calibrate({ "none.png" }, board); }, { "turned", "even" });
  }
}

// A board of 8 x 6 squares of the former layout is one of 8 x 7 without its first row and with other numbers.
TEST(BoardCalibration, FormerLayoutOfCharuco)
{
  TemporaryFolder folder;
  const std::string text = "charuco:8x6:0.03:0.0225:DICT_5X5_250";
  const std::vector<CalibratedImage> truth = Cameras({});
  const BoardCalibration former = Calibrate(RenderAll(folder, text, truth, false, true), text);
  EXPECT_TRUE(former.hasFormerLayout);
  ExpectCameras(former, truth);
  EXPECT_FALSE(Calibrate(RenderAll(folder, text, truth, false), text).hasFormerLayout);
}

// Images of two folders with the same names and size, of lenses of 560 and 616 pixels.
TEST(BoardCalibration, TwoCamerasOfOneSize)
{
  TemporaryFolder folder;
  std::vector<CalibratedImage> truth = Cameras({});
  std::vector<std::string> files = RenderAll(folder, charucoBoard, truth, false, false, "a/");
  for (CalibratedImage& camera : truth)
  {
    camera.camera.K(0, 0) = camera.camera.K(1, 1) = 616;
  }
  const std::vector<std::string> others =
    RenderAll(folder, charucoBoard, truth, false, false, "b/");
  files.insert(files.end(), others.begin(), others.end());
  const BoardCalibration calibration = Calibrate(files, charucoBoard);
  const SparseModel model = calibration.Model(BoardFromText(charucoBoard), folder.Path());
  ASSERT_EQ(model.cameras.size(), 2u);
  EXPECT_NEAR(model.cameras[0].parameters[0], 560, 1.2);
  EXPECT_NEAR(model.cameras[1].parameters[0], 616, 1.2);
  WriteBoardPictures(calibration, folder.Path("boards"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.Path("boards")),
              std::filesystem::directory_iterator()),
    static_cast<std::ptrdiff_t>(files.size()));
}

TEST(BoardCalibration, OneCameraInTwoFolders)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({});
  std::vector<std::string> files = RenderAll(folder, charucoBoard, truth, false, false, "a/");
  const std::vector<std::string> others =
    RenderAll(folder, charucoBoard, truth, false, false, "b/");
  files.insert(files.end(), others.begin(), others.end());
  EXPECT_EQ(
    Calibrate(files, charucoBoard).Model(BoardFromText(charucoBoard), folder.Path()).cameras.size(),
    1u);
}

TEST(BoardCalibration, ImageWithoutABoardIsLeftOut)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({});
  std::vector<std::string> files = RenderAll(folder, charucoBoard, truth, false);
  files.insert(files.begin() + 1, folder.Path("empty.png"));
  cv::imwrite(files[1], cv::Mat(360, 480, CV_8U, cv::Scalar(128)));
  BoardCalibration calibration = Calibrate(files, charucoBoard);
  EXPECT_FALSE(calibration.images[1].used);
  EXPECT_FALSE(calibration.images[1].reason.empty());
  calibration.images.erase(calibration.images.begin() + 1);
  ExpectCameras(calibration, truth);
}

TEST(BoardCalibration, ModelHoldsCamerasAndCorners)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({});
  const BoardCalibration calibration =
    Calibrate(RenderAll(folder, charucoBoard, truth, false), charucoBoard);
  const SparseModel model = calibration.Model(BoardFromText(charucoBoard), folder.Path());
  ASSERT_EQ(model.cameras.size(), 1u);
  EXPECT_EQ(model.cameras[0].model, LensModel::SimplePinhole);
  ASSERT_EQ(model.images.size(), truth.size());
  EXPECT_EQ(model.images[1].name, "image1.png");
  EXPECT_EQ(model.points.size(), 35u);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const SparseTracks tracks(model);
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    EXPECT_EQ(tracks.ofPoint[i].size(), model.points[i].track.size());
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      const Eigen::Vector2d pixel = model.images[link.image].observations[link.observation].pixel;
      EXPECT_LT((images[link.image].camera.Project(model.points[i].position) - pixel).norm(), 0.5);
    }
  }
}

TEST(BoardCalibration, AnnotatedPictures)
{
  TemporaryFolder folder;
  const std::vector<std::string> files = RenderAll(folder, charucoBoard, Cameras({}), false);
  const BoardCalibration calibration = Calibrate(files, charucoBoard);
  WriteBoardPictures(calibration, folder.Path("boards"));
  const cv::Mat drawn = cv::imread(folder.Path("boards/image0.jpg"));
  ASSERT_EQ(drawn.cols, 480);
  // Each corner has a red ring around it, which is not lost in the JPEG.
  const cv::Mat inside = drawn(cv::Rect(8, 8, drawn.cols - 16, drawn.rows - 16));
  for (const Eigen::Vector2d& pixel : calibration.images[0].corners.pixels)
  {
    if (!cv::Rect(16, 16, drawn.cols - 32, drawn.rows - 32)
           .contains(cv::Point(pixel.x(), pixel.y())))
    {
      continue;
    }
    int red = 0;
    for (int i = 0; i < 17 * 17; ++i)
    {
      const cv::Vec3b& color = inside.at<cv::Vec3b>(
        static_cast<int>(pixel.y()) - 16 + i / 17, static_cast<int>(pixel.x()) - 16 + i % 17);
      red += color[2] > color[1] + 60 && color[2] > color[0] + 60;
    }
    EXPECT_GT(red, 5) << pixel.transpose();
  }
  EXPECT_THROW(WriteBoardPictures(calibration, "/no/such/folder/boards"), Error);
}

TEST(BoardCalibration, TooFewImages)
{
  TemporaryFolder folder;
  std::vector<CalibratedImage> two = Cameras({});
  two.resize(2);
  const std::vector<std::string> files = RenderAll(folder, charucoBoard, two, false);
  ExpectError([&]() { Calibrate(files, charucoBoard); }, { "fewer than three" });
  ExpectError([&]() { Calibrate({}, charucoBoard); }, { "none of 0" });
}

// Two images of another camera do not spoil the others.
TEST(BoardCalibration, ImagesOfAnotherSizeThatAreTooFew)
{
  TemporaryFolder folder;
  const std::vector<CalibratedImage> truth = Cameras({});
  std::vector<std::string> files = RenderAll(folder, charucoBoard, truth, false);
  for (int i = 0; i < 2; ++i)
  {
    cv::Mat larger;
    cv::resize(cv::imread(files[i], cv::IMREAD_GRAYSCALE), larger, {}, 1.5, 1.5);
    files.push_back(folder.Path("larger" + std::to_string(i) + ".png"));
    cv::imwrite(files.back(), larger);
  }
  BoardCalibration calibration = Calibrate(files, charucoBoard);
  for (std::size_t i = truth.size(); i < files.size(); ++i)
  {
    EXPECT_FALSE(calibration.images[i].used);
    EXPECT_FALSE(calibration.images[i].reason.empty());
  }
  calibration.images.resize(truth.size());
  ExpectCameras(calibration, truth);
}

// The same image again and again tells nothing more: a camera or an error, but no crash.
TEST(BoardCalibration, OneImageThreeTimes)
{
  TemporaryFolder folder;
  std::vector<CalibratedImage> one = Cameras({});
  one.resize(1);
  const std::string file = RenderAll(folder, charucoBoard, one, false).front();
  try
  {
    const BoardCalibration calibration = Calibrate({ file, file, file }, charucoBoard);
    EXPECT_TRUE(std::isfinite(calibration.error));
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("calibrate"), std::string::npos);
  }
}

TEST(BoardCalibration, ImageThatIsMissingOrNone)
{
  TemporaryFolder folder;
  ExpectError(
    [&]() { Calibrate({ folder.Path("missing.png") }, charucoBoard); }, { "missing.png" });
  const std::string text = folder.Write("text.png", "this is no image");
  ExpectError([&]() { Calibrate({ text }, charucoBoard); }, { "text.png" });
}

TEST(BoardCalibration, OptionsOutOfRange)
{
  BoardCalibrationOptions options;
  options.board = BoardFromText(charucoBoard);
  options.maximumCoefficients = 3;
  EXPECT_THROW(CalibrateFromBoard({}, options), Error);
  options = {};
  EXPECT_THROW(CalibrateFromBoard({}, options), Error) << "no board";
}
