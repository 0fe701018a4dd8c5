// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoardRendering_h
#define freespace_BoardRendering_h

#include "Calibration/BoardDetection.h"

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

namespace freespace
{

inline const std::string charucoBoard = "charuco:8x6:0.03:0.0225:DICT_5X5_250";
inline const std::string chessboardBoard = "chessboard:7x6:0.03";

/// Images of a board from known cameras: every pixel averages 4 x 4 rays.
class BoardRendering
{
public:
  /// `hasFormerLayout`: that of OpenCV before 4.6, of an even number of rows and columns.
  explicit BoardRendering(const Board& board, bool hasFormerLayout = false)
    : Layout(board)
    , Texture(Draw(board))
  {
    for (int row = 0; row < board.rows && hasFormerLayout; ++row)
    {
      this->MoveSquares(row, row % 2 == 0 ? 1 : board.columns - 1);
    }
  }

  cv::Mat Render(const CalibratedImage& image) const
  {
    constexpr int samples = 4;
    const Camera& camera = image.camera;
    std::vector<cv::Point2d> shown, ideal;
    for (int y = 0; y < camera.height * samples; ++y)
    {
      for (int x = 0; x < camera.width * samples; ++x)
      {
        shown.emplace_back((x + 0.5) / samples, (y + 0.5) / samples);
      }
    }
    cv::Matx33d K;
    for (int k = 0; k < 9; ++k)
    {
      K(k / 3, k % 3) = camera.K(k / 3, k % 3);
    }
    cv::undistortPoints(shown, ideal, K, image.distortion);
    cv::Mat fine(camera.height * samples, camera.width * samples, CV_8U);
    for (std::size_t i = 0; i < ideal.size(); ++i)
    {
      const Eigen::Vector3d ray = camera.R.transpose() * Eigen::Vector3d(ideal[i].x, ideal[i].y, 1);
      const Eigen::Vector3d center = camera.Center();
      const Eigen::Vector3d hit = center - center.z() / ray.z() * ray;
      fine.at<uchar>(static_cast<int>(i)) = this->ColorAt(hit);
    }
    cv::Mat pixels;
    cv::resize(fine, pixels, { camera.width, camera.height }, 0, 0, cv::INTER_AREA);
    return pixels;
  }

private:
  static constexpr int pixelsPerSquare = 64;

  // Moves the squares of a row to the left, those at its beginning to its end.
  void MoveSquares(int row, int by)
  {
    const int top = row * pixelsPerSquare, split = by * pixelsPerSquare;
    cv::Mat squares = this->Texture.rowRange(top, top + pixelsPerSquare);
    cv::Mat moved;
    cv::hconcat(squares.colRange(split, squares.cols), squares.colRange(0, split), moved);
    moved.copyTo(squares);
  }

  static cv::Size Squares(const Board& board)
  {
    const int more = board.kind == Board::Kind::Charuco ? 0 : 1;
    return { board.columns + more, board.rows + more };
  }

  static void DrawCharuco(const Board& board, cv::Mat& texture)
  {
    const float square = static_cast<float>(board.square);
    const float marker = static_cast<float>(board.marker);
    const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250);
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
    cv::aruco::CharucoBoard({ board.columns, board.rows }, square, marker, dictionary)
      .generateImage(texture.size(), texture);
#else
    cv::aruco::CharucoBoard::create(board.columns, board.rows, square, marker, dictionary)
      ->draw(texture.size(), texture);
#endif
  }

  static cv::Mat Draw(const Board& board)
  {
    const cv::Size squares = Squares(board);
    cv::Mat texture(squares.height * pixelsPerSquare, squares.width * pixelsPerSquare, CV_8U);
    if (board.kind == Board::Kind::Charuco)
    {
      DrawCharuco(board, texture);
      return texture;
    }
    for (int y = 0; y < texture.rows; ++y)
    {
      for (int x = 0; x < texture.cols; ++x)
      {
        texture.at<uchar>(y, x) = (x / pixelsPerSquare + y / pixelsPerSquare) % 2 ? 255 : 0;
      }
    }
    return texture;
  }

  uchar ColorAt(const Eigen::Vector3d& point) const
  {
    const double scale = pixelsPerSquare / this->Layout.square;
    const double x = point.x() * scale + this->Texture.cols / 2.0;
    const double y = this->Texture.rows / 2.0 - point.y() * scale;
    const bool onBoard = x >= 0 && y >= 0 && x < this->Texture.cols && y < this->Texture.rows;
    const uchar color =
      onBoard ? this->Texture.at<uchar>(static_cast<int>(y), static_cast<int>(x)) : uchar(255);
    return static_cast<uchar>(30 + color * 190 / 255);
  }

  Board Layout;
  cv::Mat Texture;
};

/// A camera of 480 x 360 pixels that looks at the middle of the board from a direction, given in degrees
/// to the right and up, rolled by some degrees.
inline CalibratedImage BoardCamera(double right, double up, double roll, double distance)
{
  constexpr double radian = 3.14159265358979323846 / 180;
  CalibratedImage image;
  image.camera.width = 480;
  image.camera.height = 360;
  image.camera.K << 560, 0, 246.5, 0, 560, 176, 0, 0, 1;
  // Over the board, z towards it, y against the board's.
  const Eigen::Matrix3d above = Eigen::Vector3d(1, -1, -1).asDiagonal();
  image.camera.R = Eigen::AngleAxisd(roll * radian, Eigen::Vector3d::UnitZ()) *
    Eigen::AngleAxisd(right * radian, Eigen::Vector3d::UnitY()) *
    Eigen::AngleAxisd(up * radian, Eigen::Vector3d::UnitX()) * above;
  image.camera.t = { 0.01, -0.01, distance };
  return image;
}

}

#endif
