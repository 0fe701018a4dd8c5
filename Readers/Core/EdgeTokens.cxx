// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeTokens.h"

#include "Error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace freespace
{

namespace
{

// Where the colours of a side are taken, pixels from the edge.
constexpr double SideDistances[4] = { 1.5, 2.5, 3.5, 5.0 };

// An edge pixel whose position is known to a fraction of a pixel (first pixel centre at 0, 0).
struct EdgePoint
{
  float x, y;
  float gx, gy;   // gradient, grey levels per pixel
  float contrast; // its length, in the noise of middle grey
  int next = -1, previous = -1;
};

cv::Mat SmoothGrey(const cv::Mat& image, double sigma)
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
  const int width = 2 * static_cast<int>(std::ceil(2.5 * sigma)) + 1;
  cv::GaussianBlur(smooth, smooth, cv::Size(width, width), sigma, sigma, cv::BORDER_REPLICATE);
  return smooth;
}

// Central differences of one row and the squared slope; the first and last pixel stay zero.
struct GradientRow
{
  explicit GradientRow(int width)
    : x(width, 0.0f)
    , y(width, 0.0f)
    , squared(width, 0.0f)
  {
  }

  void Compute(const cv::Mat& smooth, int row)
  {
    const float* above = smooth.ptr<float>(row - 1);
    const float* here = smooth.ptr<float>(row);
    const float* below = smooth.ptr<float>(row + 1);
    const int last = smooth.cols - 1;
    float *gx = this->x.data(), *gy = this->y.data(), *slope = this->squared.data();
    for (int i = 1; i < last; ++i)
    {
      gx[i] = 0.5f * (here[i + 1] - here[i - 1]);
      gy[i] = 0.5f * (below[i] - above[i]);
      slope[i] = gx[i] * gx[i] + gy[i] * gy[i];
    }
  }

  std::vector<float> x, y, squared;
};

// Noise grows with the square root of the light, therefore so does the slope that makes an edge.
// The offset stands for the noise without light. Slopes, squared, are scaled to those of middle
// grey.
constexpr float NoiseScaleOffset = 8;
constexpr float NoiseScaleNumerator = 128 + NoiseScaleOffset;
float NoiseScale(float grey)
{
  return NoiseScaleNumerator / (grey + NoiseScaleOffset);
}

// Vertex of the parabola through the slopes at -1, 0 and 1, which are given squared, the middle one
// being the largest. For a step over square pixels and central differences it is exact.
float PeakOffset(float before, float peak, float after)
{
  const float a = std::sqrt(before), b = std::sqrt(peak), c = std::sqrt(after);
  const float curvature = a - 2 * b + c;
  return curvature < 0 ? 0.5f * (a - c) / curvature : 0.0f;
}

// The points of one row where the slope is greatest across the edge; `index` holds the number of
// each pixel's point or -1.
void FindPointsInRow(const cv::Mat& smooth, int y, const GradientRow& above, const GradientRow& row,
  const GradientRow& below, float low, std::vector<EdgePoint>& points, int* index)
{
  const float* grey = smooth.ptr<float>(y);
  const float* slope = row.squared.data();
  const float scale = low * low / NoiseScaleNumerator;
  for (int x = 1; x + 1 < smooth.cols; ++x)
  {
    if (slope[x] < scale * (grey[x] + NoiseScaleOffset))
    {
      continue;
    }
    const bool alongX = std::abs(row.x[x]) >= std::abs(row.y[x]);
    const float before = alongX ? slope[x - 1] : above.squared[x];
    const float after = alongX ? slope[x + 1] : below.squared[x];
    const float contrast = slope[x] * NoiseScale(grey[x]);
    if (slope[x] > before && slope[x] >= after)
    {
      const float offset = PeakOffset(before, slope[x], after);
      index[x] = static_cast<int>(points.size());
      points.push_back({ x + (alongX ? offset : 0), y + (alongX ? 0 : offset), row.x[x], row.y[x],
        std::sqrt(contrast) });
    }
  }
}

std::vector<EdgePoint> FindPoints(const cv::Mat& smooth, double lowContrast, cv::Mat& index)
{
  std::vector<EdgePoint> points;
  index.create(smooth.size(), CV_32S);
  index.setTo(-1);
  GradientRow above(smooth.cols), row(smooth.cols), below(smooth.cols);
  row.Compute(smooth, 1);
  for (int y = 1; y + 1 < smooth.rows; ++y)
  {
    if (y + 2 < smooth.rows)
    {
      below.Compute(smooth, y + 1);
    }
    else
    {
      below = GradientRow(smooth.cols);
    }
    FindPointsInRow(
      smooth, y, above, row, below, static_cast<float>(lowContrast), points, index.ptr<int>(y));
    std::swap(above, row);
    std::swap(row, below);
  }
  return points;
}

// How well `to` continues the edge at `from`: 1 / distance^2, positive when it lies ahead (the
// gradient pointing to the right), negative behind, 0 when the two do not belong together.
float LinkScore(const EdgePoint& from, const EdgePoint& to)
{
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float along = dx * from.gy - dy * from.gx, alongTo = dx * to.gy - dy * to.gx;
  if (from.gx * to.gx + from.gy * to.gy <= 0 || along * alongTo <= 0)
  {
    return 0;
  }
  const float score = 1 / (dx * dx + dy * dy);
  return along > 0 ? score : -score;
}

// The nearest points ahead of and behind a point, at most two pixels around it, with their scores.
struct Neighbors
{
  int ahead = -1, behind = -1;
  float aheadScore = 0, behindScore = 0;
};

Neighbors FindNeighbors(const std::vector<EdgePoint>& points, const cv::Mat& index, int i)
{
  constexpr int radius = 2;
  const int x = static_cast<int>(std::lround(points[i].x));
  const int y = static_cast<int>(std::lround(points[i].y));
  Neighbors best;
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
      if (score > best.aheadScore)
      {
        best.ahead = j;
        best.aheadScore = score;
      }
      else if (score < best.behindScore)
      {
        best.behind = j;
        best.behindScore = score;
      }
    }
  }
  return best;
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

// Links each point to the best one ahead and behind; a point that two want goes to the nearer.
void LinkPoints(std::vector<EdgePoint>& points, const cv::Mat& index)
{
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    const Neighbors best = FindNeighbors(points, index, i);
    if (best.ahead >= 0 && points[i].next != best.ahead)
    {
      const int rival = points[best.ahead].previous;
      if (rival < 0 || LinkScore(points[rival], points[best.ahead]) < best.aheadScore)
      {
        Link(points, i, best.ahead);
      }
    }
    if (best.behind >= 0 && points[i].previous != best.behind)
    {
      const int rival = points[best.behind].next;
      if (rival < 0 || LinkScore(points[rival], points[best.behind]) > best.behindScore)
      {
        Link(points, best.behind, i);
      }
    }
  }
}

// Weights that give the value of the parabola fitted to 2 * radius + 1 equally spaced values at the
// middle one (Savitzky and Golay). Three values make no parabola worth the name: their mean.
std::vector<double> ParabolaWeights(int radius)
{
  if (radius <= 1)
  {
    return std::vector<double>(2 * radius + 1, 1.0 / (2 * radius + 1));
  }
  const double n = 2 * radius + 1;
  double s2 = 0, s4 = 0;
  for (int j = -radius; j <= radius; ++j)
  {
    s2 += std::pow(j, 2);
    s4 += std::pow(j, 4);
  }
  std::vector<double> weights;
  for (int j = -radius; j <= radius; ++j)
  {
    weights.push_back((s4 - s2 * j * j) / (n * s4 - s2 * s2));
  }
  return weights;
}

// Turns linked points into tokens.
class TokenMaker
{
public:
  TokenMaker(const std::vector<EdgePoint>& points, const cv::Mat& colors, int fitRadius)
    : Points(points)
    , Colors(colors)
  {
    for (int radius = 0; radius <= fitRadius; ++radius)
    {
      this->Weights.push_back(ParabolaWeights(radius));
    }
  }

  // The k-th token of a chain; a closed chain has no ends.
  EdgeToken Make(const std::vector<int>& chain, int k, bool closed) const
  {
    const int size = static_cast<int>(chain.size());
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    const int radius =
      closed ? std::min(greatest, (size - 1) / 2) : std::min({ greatest, k, size - 1 - k });
    const EdgePoint& center = this->Points[chain[k]];
    EdgeToken token;
    token.contrast = center.contrast;
    token.position = Eigen::Vector2d::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::Zero();
    const std::vector<double>& weights = this->Weights[radius];
    for (int j = -radius; j <= radius; ++j)
    {
      const Eigen::Vector2d position = this->Position(chain[(k + j + size) % size]);
      token.position += weights[j + radius] * position;
      along += j * position;
    }
    if (radius < 2) // at an end
    {
      const int first = std::clamp(k - 2, 0, std::max(0, size - 5));
      along = this->Position(chain[std::min(first + 4, size - 1)]) - this->Position(chain[first]);
    }
    const Eigen::Vector2d level(center.gy, -center.gx); // across the gradient
    token.position += Eigen::Vector2d(0.5, 0.5);
    token.tangent = (along.dot(level) > 0 ? along : level).normalized();
    this->AddColors(token);
    return token;
  }

private:
  Eigen::Vector2d Position(int point) const
  {
    return { this->Points[point].x, this->Points[point].y };
  }

  void AddColors(EdgeToken& token) const
  {
    token.bright.fill(0);
    token.dark.fill(0);
    const Eigen::Vector2d normal = token.Normal();
    for (int k = 0; k < 4; ++k)
    {
      const Eigen::Vector2d offset = SideDistances[k] * normal;
      std::copy_n(this->ColorAt(token.position + offset).val, 3, token.bright.begin() + 3 * k);
      std::copy_n(this->ColorAt(token.position - offset).val, 3, token.dark.begin() + 3 * k);
    }
    std::copy_n(this->ColorAt(token.position).val, 3, token.color.begin());
  }

  const cv::Vec3b& ColorAt(const Eigen::Vector2d& pixel) const
  {
    const int x = std::clamp(static_cast<int>(pixel.x()), 0, this->Colors.cols - 1);
    const int y = std::clamp(static_cast<int>(pixel.y()), 0, this->Colors.rows - 1);
    return this->Colors.at<cv::Vec3b>(y, x);
  }

  const std::vector<EdgePoint>& Points;
  const cv::Mat& Colors;
  std::vector<std::vector<double>> Weights; // by radius
};

// A little blurred, so that a single sample stands for its neighbourhood.
cv::Mat BlurredColors(const cv::Mat& image)
{
  cv::Mat colors;
  cv::blur(image, colors, cv::Size(3, 3));
  if (colors.channels() == 1)
  {
    cv::cvtColor(colors, colors, cv::COLOR_GRAY2BGR);
  }
  return colors;
}

// Follows the links from each chain's first point, then around the closed chains.
template <typename Visitor>
void VisitChains(const std::vector<EdgePoint>& points, Visitor&& visit)
{
  std::vector<char> taken(points.size(), 0);
  std::vector<int> chain;
  for (const bool closed : { false, true })
  {
    for (int start = 0; start < static_cast<int>(points.size()); ++start)
    {
      if (taken[start] || (!closed && points[start].previous >= 0))
      {
        continue;
      }
      chain.clear();
      for (int i = start; i >= 0 && !taken[i]; i = points[i].next)
      {
        taken[i] = 1;
        chain.push_back(i);
      }
      visit(chain, closed);
    }
  }
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
  cv::Mat index;
  std::vector<EdgePoint> points =
    FindPoints(SmoothGrey(image, options.smoothing), options.lowContrast, index);
  LinkPoints(points, index);

  const cv::Mat colors = BlurredColors(image);
  const TokenMaker maker(points, colors, options.fitRadius);
  edges.tokens.reserve(points.size());
  VisitChains(points,
    [&](const std::vector<int>& chain, bool closed)
    {
      const int size = static_cast<int>(chain.size());
      const bool strong = std::any_of(chain.begin(), chain.end(),
        [&](int i) { return points[i].contrast >= options.highContrast; });
      if (!strong || size < options.minimumLength)
      {
        return;
      }
      for (int k = 0; k < size; ++k)
      {
        edges.tokens.push_back(maker.Make(chain, k, closed));
      }
      edges.begin.push_back(static_cast<int>(edges.tokens.size()));
    });
  return edges;
}

}
