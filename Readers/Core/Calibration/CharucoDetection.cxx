// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/CharucoDetection.h"

#include "Common/Error.h"

#include <algorithm>
#include <numeric>

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>

namespace freespace
{

namespace
{

struct DictionaryName
{
  const char* name;
  int number;
};

constexpr DictionaryName dictionaries[] = { { "DICT_4X4_50", cv::aruco::DICT_4X4_50 },
  { "DICT_4X4_100", cv::aruco::DICT_4X4_100 }, { "DICT_4X4_250", cv::aruco::DICT_4X4_250 },
  { "DICT_4X4_1000", cv::aruco::DICT_4X4_1000 }, { "DICT_5X5_50", cv::aruco::DICT_5X5_50 },
  { "DICT_5X5_100", cv::aruco::DICT_5X5_100 }, { "DICT_5X5_250", cv::aruco::DICT_5X5_250 },
  { "DICT_5X5_1000", cv::aruco::DICT_5X5_1000 }, { "DICT_6X6_50", cv::aruco::DICT_6X6_50 },
  { "DICT_6X6_100", cv::aruco::DICT_6X6_100 }, { "DICT_6X6_250", cv::aruco::DICT_6X6_250 },
  { "DICT_6X6_1000", cv::aruco::DICT_6X6_1000 }, { "DICT_7X7_50", cv::aruco::DICT_7X7_50 },
  { "DICT_7X7_100", cv::aruco::DICT_7X7_100 }, { "DICT_7X7_250", cv::aruco::DICT_7X7_250 },
  { "DICT_7X7_1000", cv::aruco::DICT_7X7_1000 },
  { "DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL },
  { "DICT_APRILTAG_16h5", cv::aruco::DICT_APRILTAG_16h5 },
  { "DICT_APRILTAG_25h9", cv::aruco::DICT_APRILTAG_25h9 },
  { "DICT_APRILTAG_36h10", cv::aruco::DICT_APRILTAG_36h10 },
  { "DICT_APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11 } };

// OpenCV 4.7 made dictionaries and boards values; its free functions still take pointers.
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
cv::Ptr<cv::aruco::Dictionary> PredefinedDictionary(int number)
{
  return cv::makePtr<cv::aruco::Dictionary>(cv::aruco::getPredefinedDictionary(number));
}

cv::Ptr<cv::aruco::CharucoBoard> MakeCharuco(
  const Board& board, const cv::Ptr<cv::aruco::Dictionary>& dictionary, const std::vector<int>& ids)
{
  return cv::makePtr<cv::aruco::CharucoBoard>(cv::Size(board.columns, board.rows),
    static_cast<float>(board.square), static_cast<float>(board.marker), *dictionary, ids);
}

std::vector<std::vector<cv::Point3f>> MarkerPoints(const cv::aruco::CharucoBoard& charuco)
{
  return charuco.getObjPoints();
}
#else
cv::Ptr<cv::aruco::Dictionary> PredefinedDictionary(int number)
{
  return cv::aruco::getPredefinedDictionary(number);
}

cv::Ptr<cv::aruco::CharucoBoard> MakeCharuco(
  const Board& board, const cv::Ptr<cv::aruco::Dictionary>& dictionary, const std::vector<int>& ids)
{
  auto charuco = cv::aruco::CharucoBoard::create(board.columns, board.rows,
    static_cast<float>(board.square), static_cast<float>(board.marker), dictionary);
  charuco->ids = ids;
  return charuco;
}

std::vector<std::vector<cv::Point3f>> MarkerPoints(const cv::aruco::CharucoBoard& charuco)
{
  return charuco.objPoints;
}
#endif

cv::Ptr<cv::aruco::Dictionary> FindDictionary(const Board& board)
{
  for (const DictionaryName& entry : dictionaries)
  {
    if (board.dictionary == entry.name)
    {
      auto dictionary = PredefinedDictionary(entry.number);
      if (board.columns * board.rows / 2 > dictionary->bytesList.rows)
      {
        throw Error("The dictionary " + board.dictionary + " has " +
          std::to_string(dictionary->bytesList.rows) + " markers, and a board of " +
          std::to_string(board.columns) + " x " + std::to_string(board.rows) + " squares needs " +
          std::to_string(board.columns * board.rows / 2) + ".");
      }
      return dictionary;
    }
  }
  throw Error("There is no dictionary of markers called '" + board.dictionary + "'.");
}

struct Markers
{
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
};

// How many markers lie together where a layout of the board has them.
int CountMarkersInPlace(const Markers& markers, const cv::aruco::CharucoBoard& charuco,
  const std::vector<int>& ids, double square)
{
  const auto places = MarkerPoints(charuco);
  std::vector<cv::Point2f> seen, expected;
  for (std::size_t i = 0; i < markers.ids.size(); ++i)
  {
    const auto place = std::find(ids.begin(), ids.end(), markers.ids[i]);
    for (std::size_t k = 0; k < 4 && place != ids.end(); ++k)
    {
      const cv::Point3f& point = places[static_cast<std::size_t>(place - ids.begin())][k];
      seen.push_back(markers.corners[i][k]);
      expected.emplace_back(point.x, point.y);
    }
  }
  if (seen.size() < 8) // one marker fits every layout
  {
    return 0;
  }
  constexpr double tolerance = 0.2; // of a square; lenses bend
  cv::Mat inliers;
  cv::findHomography(seen, expected, cv::RANSAC, tolerance * square, inliers);
  return cv::countNonZero(inliers) / 4;
}

BoardCorners CornersOf(const cv::Mat& gray, const Markers& markers,
  const cv::Ptr<cv::aruco::CharucoBoard>& charuco, int skippedCorners)
{
  std::vector<cv::Point2f> points, kept;
  std::vector<int> found, ids;
  cv::aruco::interpolateCornersCharuco(markers.corners, markers.ids, gray, charuco, points, found);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (found[i] >= skippedCorners)
    {
      ids.push_back(found[i] - skippedCorners);
      kept.push_back(points[i]);
    }
  }
  return CornersFromOpenCV(ids, kept);
}

}

BoardDetection DetectCharuco(const cv::Mat& gray, const Board& board)
{
  const auto dictionary = FindDictionary(board);
  Markers markers;
  cv::aruco::detectMarkers(gray, dictionary, markers.corners, markers.ids);
  BoardDetection detection;
  if (markers.ids.empty())
  {
    return detection;
  }
  std::vector<int> ids(static_cast<std::size_t>(board.columns * board.rows / 2));
  std::iota(ids.begin(), ids.end(), 0);
  const auto charuco = MakeCharuco(board, dictionary, ids);
  detection.corners = CornersOf(gray, markers, charuco, 0);
  detection.markers = CountMarkersInPlace(markers, *charuco, ids, board.square);
  if (board.rows % 2 == 0)
  {
    // The former layout of an even number of rows is the present one of a row more, without the first.
    constexpr int none = 1 << 20; // the number of no marker
    Board higher = board;
    higher.rows = board.rows + 1;
    std::vector<int> former(static_cast<std::size_t>(board.columns / 2));
    std::iota(former.begin(), former.end(), none);
    former.insert(former.end(), ids.begin(), ids.end());
    const auto formerCharuco = MakeCharuco(higher, dictionary, former);
    detection.formerCorners = CornersOf(gray, markers, formerCharuco, board.columns - 1);
    detection.formerMarkers = CountMarkersInPlace(markers, *formerCharuco, former, board.square);
  }
  return detection;
}

}
