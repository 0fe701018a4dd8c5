// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardDetection.h"

#include "Calibration/CharucoDetection.h"
#include "Common/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace freespace
{

namespace
{

constexpr double largestShift = 1.5; // of a corner against its expected place, pixels

BoardCorners DetectChessboard(const cv::Mat& gray, const Board& board)
{
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> points;
  const bool found = cv::findChessboardCorners(gray, size, points,
    cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
  if (!found)
  {
    return {};
  }
  std::vector<int> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  return CornersFromOpenCV(ids, points);
}

// The projection of the board with the lens's distortion.
class BoardProjection
{
public:
  explicit BoardProjection(const CalibratedImage& image)
    : Image(image)
  {
    cv::Matx33d rotation;
    for (int i = 0; i < 9; ++i)
    {
      rotation(i / 3, i % 3) = image.camera.R(i / 3, i % 3);
      this->Matrix(i / 3, i % 3) = image.camera.K(i / 3, i % 3);
    }
    cv::Rodrigues(rotation, this->Rotation);
    const Eigen::Vector3d& t = image.camera.t;
    this->Translation = { t.x(), t.y(), t.z() };
  }

  std::vector<Eigen::Vector2d> Project(const std::vector<Eigen::Vector3d>& points) const
  {
    std::vector<cv::Point3d> world;
    for (const Eigen::Vector3d& point : points)
    {
      world.emplace_back(point.x(), point.y(), point.z());
    }
    std::vector<cv::Point2d> projected;
    cv::projectPoints(
      world, this->Rotation, this->Translation, this->Matrix, this->Image.distortion, projected);
    std::vector<Eigen::Vector2d> pixels;
    for (const cv::Point2d& pixel : projected)
    {
      pixels.emplace_back(pixel.x, pixel.y);
    }
    return pixels;
  }

private:
  const CalibratedImage& Image;
  cv::Matx33d Matrix;
  cv::Vec3d Rotation;
  cv::Vec3d Translation;
};

bool IsInside(const cv::Mat& gray, const Eigen::Vector2d& pixel, double margin)
{
  return pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= gray.cols - margin &&
    pixel.y() <= gray.rows - margin;
}

double GrayAt(const cv::Mat& gray, const Eigen::Vector2d& pixel)
{
  const double x = pixel.x() - 0.5, y = pixel.y() - 0.5;
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, gray.cols - 2);
  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, gray.rows - 2);
  const double u = x - column, v = y - row;
  const auto value = [&](int r, int c) { return static_cast<double>(gray.at<uchar>(r, c)); };
  return (1 - v) * ((1 - u) * value(row, column) + u * value(row, column + 1)) +
    v * ((1 - u) * value(row + 1, column) + u * value(row + 1, column + 1));
}

// The free part of a square about a corner: the margin of the markers, or half a chessboard square.
double FreeReach(const Board& board)
{
  return board.kind == Board::Kind::Charuco ? (board.square - board.marker) / 2 : board.square / 2;
}

// Finds one corner by the four edges that meet in it. cv::cornerSubPix does so in an upright window,
// which must not reach the markers; here the edges are followed for nearly half a square each, and only
// gradients count that are across their edge and of the sign that the squares demand. So markers, shadows
// and occlusions do not disturb it.
class CornerFinder
{
public:
  CornerFinder(const cv::Mat& gray, const BoardProjection& projection,
    const Eigen::Vector3d& corner, const Board& board)
    : Gray(gray)
    , Band(0.8 * std::min(FreeReach(board) / board.square, 0.15))
  {
    const double s = board.square;
    const std::vector<Eigen::Vector2d> pixels = projection.Project(
      { corner, corner + Eigen::Vector3d(s / 4, 0, 0), corner - Eigen::Vector3d(s / 4, 0, 0),
        corner + Eigen::Vector3d(0, s / 4, 0), corner - Eigen::Vector3d(0, s / 4, 0) });
    this->Expected = pixels[0];
    this->PixelFromSquare.col(0) = 2 * (pixels[1] - pixels[2]);
    this->PixelFromSquare.col(1) = 2 * (pixels[3] - pixels[4]);
  }

  // False if the corner is hidden, ambiguous or too far from its expected position.
  bool Find(Eigen::Vector2d& found) const
  {
    const double sides =
      std::min(this->PixelFromSquare.col(0).norm(), this->PixelFromSquare.col(1).norm());
    return sides >= 8 && this->LooksLikeACorner() &&
      (this->FollowEdges(0.45, found) || this->FollowEdges(std::max(this->Band, 0.2), found));
  }

private:
  // Coordinates in units of a square, from a centre.
  Eigen::Vector2d PixelAt(const Eigen::Vector2d& center, double x, double y) const
  {
    return center + this->PixelFromSquare * Eigen::Vector2d(x, y);
  }

  // The two squares on one diagonal are clearly brighter than the two on the other, and alike.
  bool LooksLikeACorner() const
  {
    const double d = this->Band;
    const Eigen::Vector2d diagonal[] = { { d, d }, { -d, d }, { -d, -d }, { d, -d } };
    std::array<double, 4> g;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Eigen::Vector2d pixel = this->PixelAt(this->Expected, diagonal[i].x(), diagonal[i].y());
      if (!IsInside(this->Gray, pixel, 2))
      {
        return false;
      }
      g[i] = GrayAt(this->Gray, pixel);
    }
    const double contrast = std::abs(g[0] + g[2] - g[1] - g[3]) / 2;
    const double unlike = std::max(std::abs(g[0] - g[2]), std::abs(g[1] - g[3]));
    this->Bright = g[0] + g[2] > g[1] + g[3] ? 1 : -1;
    return contrast > 20 && unlike < 0.5 * contrast;
  }

  // The point to which all gradients near the edges are perpendicular.
  bool FollowEdges(double reach, Eigen::Vector2d& found) const
  {
    found = this->Expected;
    for (int iteration = 0; iteration < 8; ++iteration)
    {
      Eigen::Vector2d next;
      if (!this->Intersect(found, reach, next) || (next - this->Expected).norm() > largestShift)
      {
        return false;
      }
      const double step = (next - found).norm();
      found = next;
      if (step < 1e-3)
      {
        break;
      }
    }
    return true;
  }

  bool Intersect(const Eigen::Vector2d& center, double reach, Eigen::Vector2d& result) const
  {
    const Eigen::Matrix2d squareFromPixel = this->PixelFromSquare.inverse();
    const Eigen::Vector2d extent =
      reach * this->PixelFromSquare.cwiseAbs().rowwise().sum() + Eigen::Vector2d(1, 1);
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    std::array<int, 4> supported = { 0, 0, 0, 0 }, expected = { 0, 0, 0, 0 };
    for (int row = static_cast<int>(center.y() - extent.y()); row <= center.y() + extent.y(); ++row)
    {
      for (int column = static_cast<int>(center.x() - extent.x());
           column <= center.x() + extent.x(); ++column)
      {
        const Eigen::Vector2d pixel(column + 0.5, row + 0.5);
        const Eigen::Vector2d at = squareFromPixel * (pixel - center);
        const int arm = ArmOf(at, reach);
        if (arm < 0 || !IsInside(this->Gray, pixel, 2))
        {
          continue;
        }
        const bool onEdge = this->DistanceToEdge(at) < 0.7;
        expected[static_cast<std::size_t>(arm)] += onEdge;
        const Eigen::Vector2d gradient = this->GradientAt(row, column);
        if (this->Fits(gradient, arm))
        {
          supported[static_cast<std::size_t>(arm)] += onEdge;
          normal += gradient * gradient.transpose();
          right += gradient * gradient.dot(pixel);
        }
      }
    }
    for (std::size_t arm = 0; arm < 4; ++arm)
    {
      if (expected[arm] < 2 || supported[arm] < 0.7 * expected[arm])
      {
        return false;
      }
    }
    result = normal.ldlt().solve(right);
    return result.allFinite();
  }

  // 0 along +x, 1 along +y, 2 along -x, 3 along -y; -1 when not near an edge.
  int ArmOf(const Eigen::Vector2d& at, double reach) const
  {
    const double x = std::abs(at.x()), y = std::abs(at.y());
    if (std::min(x, y) > this->Band || std::max(x, y) > reach)
    {
      return -1;
    }
    return x >= y ? (at.x() > 0 ? 0 : 2) : (at.y() > 0 ? 1 : 3);
  }

  // In pixels, of a place near an edge.
  double DistanceToEdge(const Eigen::Vector2d& at) const
  {
    const int axis = std::abs(at.x()) >= std::abs(at.y()) ? 0 : 1;
    const double area = std::abs(this->PixelFromSquare.determinant());
    return std::abs(at[1 - axis]) * area / this->PixelFromSquare.col(axis).norm();
  }

  // Within 25 degrees of across the edge, from the dark to the bright square.
  bool Fits(const Eigen::Vector2d& gradient, int arm) const
  {
    const Eigen::Vector2d edge = this->PixelFromSquare.col(arm % 2).normalized();
    const double turn = this->PixelFromSquare.determinant() > 0 ? 1 : -1;
    // Across the edge, towards the other axis. Bright is where x and y have the same sign.
    const Eigen::Vector2d across = turn * Eigen::Vector2d(-edge.y(), edge.x());
    const double sign = (arm == 0 || arm == 3 ? 1 : -1) * this->Bright;
    const double strength = gradient.norm();
    return strength > 3 && sign * across.dot(gradient) > 0.9 * strength;
  }

  Eigen::Vector2d GradientAt(int row, int column) const
  {
    const auto value = [&](int r, int c)
    { return static_cast<double>(this->Gray.at<uchar>(r, c)); };
    return { (value(row, column + 1) - value(row, column - 1)) / 2,
      (value(row + 1, column) - value(row - 1, column)) / 2 };
  }

  const cv::Mat& Gray;
  double Band; // half width of what is looked at about the edges, in squares
  Eigen::Vector2d Expected;
  Eigen::Matrix2d PixelFromSquare;
  mutable double Bright = 1; // 1: the squares of x y > 0 are the bright ones, else -1
};

}

BoardCorners CornersFromOpenCV(const std::vector<int>& ids, const std::vector<cv::Point2f>& points)
{
  BoardCorners corners;
  corners.ids = ids;
  for (const cv::Point2f& point : points)
  {
    corners.pixels.emplace_back(point.x + 0.5, point.y + 0.5);
  }
  return corners;
}

std::vector<Eigen::Vector3d> BoardPoints(const Board& board)
{
  const bool charuco = board.kind == Board::Kind::Charuco;
  const int columns = charuco ? board.columns - 1 : board.columns;
  const int rows = charuco ? board.rows - 1 : board.rows;
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      points.emplace_back(
        (column - (columns - 1) / 2.0) * board.square, ((rows - 1) / 2.0 - row) * board.square, 0);
    }
  }
  return points;
}

BoardDetection DetectLayouts(const cv::Mat& gray, const Board& board)
{
  board.Check();
  if (board.kind == Board::Kind::Charuco)
  {
    return DetectCharuco(gray, board);
  }
  BoardDetection detection;
  detection.corners = DetectChessboard(gray, board);
  return detection;
}

BoardCorners DetectBoard(const cv::Mat& gray, const Board& board)
{
  const BoardDetection detection = DetectLayouts(gray, board);
  return detection.formerMarkers > detection.markers ? detection.formerCorners : detection.corners;
}

BoardCorners FindBoardCorners(const cv::Mat& gray, const Board& board, const CalibratedImage& image)
{
  const BoardProjection projection(image);
  const std::vector<Eigen::Vector3d> points = BoardPoints(board);
  BoardCorners corners;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (image.camera.Depth(points[i]) <= 0)
    {
      continue;
    }
    Eigen::Vector2d pixel;
    if (CornerFinder(gray, projection, points[i], board).Find(pixel))
    {
      corners.ids.push_back(static_cast<int>(i));
      corners.pixels.push_back(pixel);
    }
  }
  return corners;
}

cv::Mat DrawBoardCorners(const cv::Mat& image, const BoardCorners& corners)
{
  cv::Mat drawn = image.clone();
  const int size = std::max(3, std::max(image.cols, image.rows) / 250);
  constexpr int shift = 4; // fractional bits of the drawing functions
  for (std::size_t i = 0; i < corners.ids.size(); ++i)
  {
    const cv::Point center(static_cast<int>(std::lround((corners.pixels[i].x() - 0.5) * 16)),
      static_cast<int>(std::lround((corners.pixels[i].y() - 0.5) * 16)));
    cv::circle(drawn, center, size << shift, { 0, 0, 255 }, 1, cv::LINE_AA, shift);
    cv::putText(drawn, std::to_string(corners.ids[i]),
      { (center.x >> shift) + size, (center.y >> shift) - size }, cv::FONT_HERSHEY_SIMPLEX,
      0.08 * size, { 0, 160, 0 }, 1, cv::LINE_AA);
  }
  return drawn;
}

}
