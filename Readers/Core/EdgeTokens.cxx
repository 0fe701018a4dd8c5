// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeTokens.h"

#include "Error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// Where the colours of a side are taken, pixels from the edge.
constexpr double SideDistances[3] = { 1.5, 3.0, 4.5 };

// An edge pixel whose position is known to a fraction of a pixel (first pixel centre at 0, 0).
struct EdgePoint
{
  float x, y;
  float gx, gy; // gradient, grey levels per pixel
  float slope;  // its magnitude
  int next = -1, previous = -1;
};

// The slope of the smoothed image and its magnitude.
struct Gradient
{
  cv::Mat x, y, magnitude;
};

Gradient ComputeGradient(const cv::Mat& image, double sigma)
{
  cv::Mat grey, smooth;
  if (image.channels() == 3)
  {
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  }
  else
  {
    grey = image;
  }
  grey.convertTo(smooth, CV_32F);
  const int width = 2 * static_cast<int>(std::ceil(3 * sigma)) + 1;
  cv::GaussianBlur(smooth, smooth, cv::Size(width, width), sigma, sigma, cv::BORDER_REPLICATE);
  Gradient gradient;
  const double perPixel = 1.0 / 8; // Sobel's weights add up to 4, over 2 pixels
  cv::Sobel(smooth, gradient.x, CV_32F, 1, 0, 3, perPixel, 0, cv::BORDER_REPLICATE);
  cv::Sobel(smooth, gradient.y, CV_32F, 0, 1, 3, perPixel, 0, cv::BORDER_REPLICATE);
  cv::magnitude(gradient.x, gradient.y, gradient.magnitude);
  return gradient;
}

// Vertex of the parabola through the logarithms at -1, 0 and 1, the middle one being the largest.
float PeakOffset(float before, float peak, float after)
{
  const float floor = 0.05f * peak; // keeps the logarithm of an empty neighbour at bay
  const float a = std::log(std::max(before, floor) / peak);
  const float b = std::log(std::max(after, floor) / peak);
  return a + b < 0 ? 0.5f * (a - b) / (a + b) : 0.0f;
}

// Points where the slope is greatest across the edge, at most one in a pixel; `index` holds the
// number of each pixel's point or -1.
std::vector<EdgePoint> FindPoints(const Gradient& gradient, double lowContrast, cv::Mat& index)
{
  std::vector<EdgePoint> points;
  index.create(gradient.magnitude.size(), CV_32S);
  index.setTo(-1);
  const float low = static_cast<float>(lowContrast);
  for (int y = 1; y + 1 < index.rows; ++y)
  {
    const float* above = gradient.magnitude.ptr<float>(y - 1);
    const float* row = gradient.magnitude.ptr<float>(y);
    const float* below = gradient.magnitude.ptr<float>(y + 1);
    const float* gx = gradient.x.ptr<float>(y);
    const float* gy = gradient.y.ptr<float>(y);
    for (int x = 1; x + 1 < index.cols; ++x)
    {
      if (row[x] < low)
      {
        continue;
      }
      const bool alongX = std::abs(gx[x]) >= std::abs(gy[x]);
      const float before = alongX ? row[x - 1] : above[x];
      const float after = alongX ? row[x + 1] : below[x];
      if (!(row[x] > before && row[x] >= after))
      {
        continue;
      }
      const float offset = PeakOffset(before, row[x], after);
      index.at<int>(y, x) = static_cast<int>(points.size());
      points.push_back(
        { x + (alongX ? offset : 0), y + (alongX ? 0 : offset), gx[x], gy[x], row[x] });
    }
  }
  return points;
}

// How well `to` continues the edge at `from`: 1 / distance, positive when it lies ahead (the
// gradient pointing to the right), negative behind, 0 when the two do not belong together.
float LinkScore(const EdgePoint& from, const EdgePoint& to)
{
  const float dx = to.x - from.x, dy = to.y - from.y;
  if (from.gx * to.gx + from.gy * to.gy <= 0)
  {
    return 0;
  }
  const float along = dx * from.gy - dy * from.gx, alongTo = dx * to.gy - dy * to.gx;
  if (along * alongTo <= 0)
  {
    return 0;
  }
  const float score = 1 / std::hypot(dx, dy);
  return along > 0 ? score : -score;
}

void Link(std::vector<EdgePoint>& points, int from, int to)
{
  EdgePoint& a = points[from];
  EdgePoint& b = points[to];
  if (a.next >= 0)
  {
    points[a.next].previous = -1;
  }
  if (b.previous >= 0)
  {
    points[b.previous].next = -1;
  }
  a.next = to;
  b.previous = from;
}

// The nearest points ahead of and behind a point, at most `radius` pixels around it; -1 for none.
std::array<int, 2> FindNeighbors(
  const std::vector<EdgePoint>& points, const cv::Mat& index, int i, int radius)
{
  const int x = static_cast<int>(std::lround(points[i].x));
  const int y = static_cast<int>(std::lround(points[i].y));
  std::array<int, 2> best = { -1, -1 };
  float ahead = 0, behind = 0;
  for (int v = std::max(0, y - radius); v <= std::min(index.rows - 1, y + radius); ++v)
  {
    const int* row = index.ptr<int>(v);
    for (int u = std::max(0, x - radius); u <= std::min(index.cols - 1, x + radius); ++u)
    {
      const int j = row[u];
      if (j < 0 || j == i)
      {
        continue;
      }
      const float score = LinkScore(points[i], points[j]);
      if (score > ahead)
      {
        ahead = score;
        best[0] = j;
      }
      if (score < behind)
      {
        behind = score;
        best[1] = j;
      }
    }
  }
  return best;
}

// Links each point to the best one ahead and behind; a point that two want goes to the nearer.
void LinkPoints(std::vector<EdgePoint>& points, const cv::Mat& index)
{
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    const auto [ahead, behind] = FindNeighbors(points, index, i, 2);
    if (ahead >= 0 && points[i].next != ahead)
    {
      const int rival = points[ahead].previous;
      if (rival < 0 ||
        LinkScore(points[rival], points[ahead]) < LinkScore(points[i], points[ahead]))
      {
        Link(points, i, ahead);
      }
    }
    if (behind >= 0 && points[i].previous != behind)
    {
      const int rival = points[behind].next;
      if (rival < 0 ||
        LinkScore(points[rival], points[behind]) > LinkScore(points[i], points[behind]))
      {
        Link(points, behind, i);
      }
    }
  }
}

// Follows the links from a point and marks the points as taken.
std::vector<int> TakeChain(
  const std::vector<EdgePoint>& points, int start, std::vector<char>& taken)
{
  std::vector<int> chain;
  for (int i = start; i >= 0 && !taken[i]; i = points[i].next)
  {
    taken[i] = 1;
    chain.push_back(i);
  }
  return chain;
}

// A parabola through the points k - radius .. k + radius of a chain (fewer at its ends).
EdgeToken FitToken(
  const std::vector<EdgePoint>& points, const std::vector<int>& chain, int k, int fitRadius)
{
  const int size = static_cast<int>(chain.size());
  const int begin = std::max(0, k - fitRadius), end = std::min(size - 1, k + fitRadius);
  const EdgePoint& center = points[chain[k]];
  // Arc length as the parameter: tokens are not equally spaced.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  const Eigen::Vector2d along(center.gy / center.slope, -center.gx / center.slope);
  for (int j = begin; j <= end; ++j)
  {
    const EdgePoint& p = points[chain[j]];
    const Eigen::RowVector2d d(p.x - center.x, p.y - center.y);
    const double distance = d.norm();
    const double s = j < k ? -distance : distance;
    const Eigen::Vector3d basis(1, s, s * s);
    normal += basis * basis.transpose();
    right += basis * d;
  }
  EdgeToken token;
  token.position = Eigen::Vector2d(center.x + 0.5, center.y + 0.5);
  token.tangent = along;
  token.contrast = center.slope;
  if (end - begin >= 4)
  {
    const Eigen::Matrix<double, 3, 2> fit = normal.ldlt().solve(right);
    token.position += fit.row(0).transpose();
    const Eigen::Vector2d tangent = fit.row(1).transpose();
    if (tangent.dot(along) > 0)
    {
      token.tangent = tangent.normalized();
    }
  }
  return token;
}

const cv::Vec3b& ColorAt(const cv::Mat& colors, const Eigen::Vector2d& pixel)
{
  const int x = std::clamp(static_cast<int>(pixel.x()), 0, colors.cols - 1);
  const int y = std::clamp(static_cast<int>(pixel.y()), 0, colors.rows - 1);
  return colors.at<cv::Vec3b>(y, x);
}

EdgeSide SampleSide(const cv::Mat& colors, const EdgeToken& token, double sign)
{
  EdgeSide side;
  for (int k = 0; k < 3; ++k)
  {
    const cv::Vec3b& color =
      ColorAt(colors, token.position + sign * SideDistances[k] * token.Normal());
    std::copy_n(color.val, 3, side.begin() + 3 * k);
  }
  return side;
}

}

void EdgeTokenOptions::Check() const
{
  if (!(this->smoothing > 0) || !(this->lowContrast > 0) ||
    !(this->highContrast >= this->lowContrast))
  {
    throw Error(
      "An edge's smoothing and contrasts must be positive, the high one not below the low.");
  }
  if (this->minimumLength < 1 || this->fitRadius < 1)
  {
    throw Error("An edge chain's least length and fit radius must be positive.");
  }
}

EdgeChains FindEdges(const cv::Mat& image, const EdgeTokenOptions& options)
{
  options.Check();
  EdgeChains edges;
  if (image.rows < 3 || image.cols < 3)
  {
    return edges;
  }
  cv::Mat index, colors;
  std::vector<EdgePoint> points =
    FindPoints(ComputeGradient(image, options.smoothing), options.lowContrast, index);
  LinkPoints(points, index);
  if (image.channels() == 3)
  {
    cv::blur(image, colors, cv::Size(3, 3));
  }
  else
  {
    cv::cvtColor(image, colors, cv::COLOR_GRAY2BGR);
    cv::blur(colors, colors, cv::Size(3, 3));
  }

  std::vector<char> taken(points.size(), 0);
  const auto addChain = [&](int start)
  {
    const std::vector<int> chain = TakeChain(points, start, taken);
    const bool strong = std::any_of(
      chain.begin(), chain.end(), [&](int i) { return points[i].slope >= options.highContrast; });
    if (!strong || static_cast<int>(chain.size()) < options.minimumLength)
    {
      return;
    }
    for (int k = 0; k < static_cast<int>(chain.size()); ++k)
    {
      EdgeToken token = FitToken(points, chain, k, options.fitRadius);
      token.bright = SampleSide(colors, token, 1);
      token.dark = SampleSide(colors, token, -1);
      std::copy_n(ColorAt(colors, token.position).val, 3, token.color.begin());
      edges.tokens.push_back(token);
    }
    edges.begin.push_back(static_cast<int>(edges.tokens.size()));
  };
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    if (points[i].previous < 0)
    {
      addChain(i);
    }
  }
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    if (!taken[i]) // a closed chain
    {
      addChain(i);
    }
  }
  return edges;
}

}
