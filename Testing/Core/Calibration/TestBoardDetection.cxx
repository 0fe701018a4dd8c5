// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardDetection.h"

#include "Calibration/BoardText.h"
#include "Common/Error.h"
#include "Support/BoardRendering.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace freespace;

namespace
{

// Every corner that the image shows, but for those near its border or near what hides a part, was found.
void ExpectAllFound(const BoardCorners& corners, const CalibratedImage& camera,
  const std::vector<Eigen::Vector3d>& points, const cv::Rect& hidden)
{
  constexpr int margin = 30; // about a square
  const cv::Rect inner(
    margin, margin, camera.camera.width - 2 * margin, camera.camera.height - 2 * margin);
  const cv::Rect about(
    hidden.x - margin, hidden.y - margin, hidden.width + 2 * margin, hidden.height + 2 * margin);
  int expected = 0;
  for (std::size_t id = 0; id < points.size(); ++id)
  {
    const Eigen::Vector2d truth = camera.camera.Project(points[id]);
    const cv::Point pixel(truth.x(), truth.y());
    if (inner.contains(pixel) && !(hidden.area() > 0 && about.contains(pixel)))
    {
      ++expected;
      EXPECT_EQ(std::count(corners.ids.begin(), corners.ids.end(), static_cast<int>(id)), 1) << id;
    }
  }
  EXPECT_GE(expected, 9) << "corners to be found";
}

// What DetectBoard says is wrong.
std::string BoardFaultOf(const Board& board)
{
  return ErrorOf([&board] { DetectBoard(cv::Mat(100, 100, CV_8U, cv::Scalar(128)), board); });
}

}

TEST(BoardPoints, LieInRowsAboutTheMiddle)
{
  // A ChArUco board of 8 x 6 squares has 7 x 5 inner corners, a chessboard is named by them.
  for (const auto& [text, columns, rows] :
    { std::tuple(charucoBoard, 7, 5), std::tuple(chessboardBoard, 7, 6) })
  {
    const std::vector<Eigen::Vector3d> points = BoardPoints(BoardFromText(text));
    ASSERT_EQ(points.size(), static_cast<std::size_t>(columns * rows)) << text;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::set<std::pair<int, int>> places;
    for (const Eigen::Vector3d& point : points)
    {
      sum += point;
      EXPECT_EQ(point.z(), 0);
      const double column = point.x() / 0.03 + (columns - 1) / 2.0;
      const double row = (rows - 1) / 2.0 - point.y() / 0.03;
      EXPECT_NEAR(column, std::round(column), 1e-9);
      EXPECT_NEAR(row, std::round(row), 1e-9);
      EXPECT_TRUE(column > -0.5 && column < columns - 0.5 && row > -0.5 && row < rows - 0.5);
      places.emplace(static_cast<int>(std::round(column)), static_cast<int>(std::round(row)));
    }
    EXPECT_EQ(places.size(), points.size()) << "each place once";
    EXPECT_LT(sum.norm(), 1e-12);
    EXPECT_LT((points[1] - points[0] - Eigen::Vector3d(0.03, 0, 0)).norm(), 1e-12)
      << "along the columns first";
  }
}

TEST(BoardDetection, ImagesWithoutABoardHaveNone)
{
  cv::Mat noise(360, 480, CV_8U);
  cv::theRNG().state = 3;
  cv::randu(noise, 0, 255);
  for (const cv::Mat& image : { cv::Mat(360, 480, CV_8U, cv::Scalar(128)), noise })
  {
    for (const std::string& text : { charucoBoard, chessboardBoard })
    {
      const Board board = BoardFromText(text);
      EXPECT_TRUE(DetectBoard(image, board).ids.empty()) << text;
      EXPECT_TRUE(FindBoardCorners(image, board, BoardCamera(20, 15, 10, 0.35)).ids.empty())
        << text;
    }
  }
}

TEST(BoardDetection, CornersAreExact)
{
  for (const std::string& text : { charucoBoard, chessboardBoard })
  {
    const Board board = BoardFromText(text);
    const CalibratedImage camera = BoardCamera(20, 15, 10, 0.35);
    const cv::Mat image = BoardRendering(board).Render(camera);
    const BoardCorners detected = DetectBoard(image, board);
    const BoardCorners corners = FindBoardCorners(image, board, camera);
    const std::vector<Eigen::Vector3d> points = BoardPoints(board);
    EXPECT_GE(detected.ids.size(), points.size() - 2) << "a marker may be missed";
    EXPECT_GE(corners.ids.size(), points.size() - 2);
    for (std::size_t i = 0; i < corners.ids.size(); ++i)
    {
      const Eigen::Vector2d truth = camera.camera.Project(points[corners.ids[i]]);
      EXPECT_LT((corners.pixels[i] - truth).norm(), 0.12) << text << " corner " << corners.ids[i];
    }
    for (std::size_t i = 0; i < detected.ids.size(); ++i)
    {
      const Eigen::Vector2d truth = camera.camera.Project(points[detected.ids[i]]);
      EXPECT_LT((detected.pixels[i] - truth).norm(), 1.5) << text << " corner " << detected.ids[i];
    }
  }
}

// A wrong corner is worse than a missing one.
TEST(BoardDetection, HiddenCornersAreNotFound)
{
  const Board board = BoardFromText(charucoBoard);
  const CalibratedImage camera = BoardCamera(20, 15, 10, 0.35);
  cv::Mat image = BoardRendering(board).Render(camera);
  const cv::Rect hidden(150, 100, 120, 120);
  cv::rectangle(image, hidden, { 120 }, cv::FILLED);
  const BoardCorners corners = FindBoardCorners(image, board, camera);
  const std::vector<Eigen::Vector3d> points = BoardPoints(board);
  ExpectAllFound(corners, camera, points, hidden);
  for (std::size_t i = 0; i < corners.ids.size(); ++i)
  {
    const Eigen::Vector2d truth = camera.camera.Project(points[corners.ids[i]]);
    EXPECT_FALSE(hidden.contains(cv::Point(truth.x(), truth.y())));
    EXPECT_LT((corners.pixels[i] - truth).norm(), 0.1);
  }
}

TEST(BoardDetection, CornersOfRandomCamerasAreExact)
{
  int found = 0, close = 0;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> angle(-35, 35), roll(-180, 180), distance(0.28, 0.4);
  const Board board = BoardFromText(charucoBoard);
  const BoardRendering rendering(board);
  const std::vector<Eigen::Vector3d> points = BoardPoints(board);
  for (int trial = 0; trial < 8; ++trial)
  {
    const CalibratedImage camera =
      BoardCamera(angle(random), angle(random), roll(random), distance(random));
    const cv::Mat image = rendering.Render(camera);
    const BoardCorners corners = FindBoardCorners(image, board, camera);
    ExpectAllFound(corners, camera, points, {});
    for (std::size_t i = 0; i < corners.ids.size(); ++i)
    {
      const Eigen::Vector2d truth = camera.camera.Project(points[corners.ids[i]]);
      const double error = (corners.pixels[i] - truth).norm();
      EXPECT_LT(error, 1) << trial << ": " << corners.ids[i];
      close += error < 0.15;
      ++found;
    }
  }
  EXPECT_GT(close, 0.95 * found)
    << "those beside the image's border and most slanted ones are less exact";
}

TEST(BoardDetection, TheLayoutIsThatOfMoreMarkers)
{
  const Board board = BoardFromText(charucoBoard);
  const CalibratedImage camera = BoardCamera(10, -8, 5, 0.32);
  for (const bool isFormer : { false, true })
  {
    const BoardDetection found =
      DetectLayouts(BoardRendering(board, isFormer).Render(camera), board);
    const int right = isFormer ? found.formerMarkers : found.markers;
    const int wrong = isFormer ? found.markers : found.formerMarkers;
    EXPECT_GE(right, 20) << "of 24; OpenCV 4.10 finds 20, 4.6 more";
    EXPECT_LE(wrong, 12) << "every second row is the same in both";
    const BoardCorners& corners = isFormer ? found.formerCorners : found.corners;
    EXPECT_GT(corners.ids.size(), 25u) << "of 35";
  }
}

TEST(BoardDetection, DictionaryThatIsUnknownOrTooSmall)
{
  Board board = BoardFromText(charucoBoard);
  board.dictionary = "DICT_3X3";
  EXPECT_NE(BoardFaultOf(board).find("DICT_3X3"), std::string::npos) << BoardFaultOf(board);
  board.dictionary = "DICT_5X5_50";
  board.columns = 15;
  board.rows = 15;
  EXPECT_NE(BoardFaultOf(board).find("DICT_5X5_50"), std::string::npos) << BoardFaultOf(board);
  EXPECT_NE(BoardFaultOf(board).find("50 markers"), std::string::npos) << BoardFaultOf(board);
}
