// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeTokens.h"

#include "Error.h"

#include <opencv2/core/hal/intrin.hpp>
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

// Three rows of slopes, and what the middle one needs to be an edge.
struct PeakFinder
{
  const float* grey;
  const GradientRow &above, &row, &below;
  float scale; // least squared slope for each grey level

  float Before(int x, bool alongX) const
  {
    return alongX ? this->row.squared[x - 1] : this->above.squared[x];
  }

  float After(int x, bool alongX) const
  {
    return alongX ? this->row.squared[x + 1] : this->below.squared[x];
  }

  bool AlongX(int x) const { return std::abs(this->row.x[x]) >= std::abs(this->row.y[x]); }

  // Whether the slope at x is steep enough and greater than before and after it.
  bool IsPeak(int x) const
  {
    const float slope = this->row.squared[x];
    const bool alongX = this->AlongX(x);
    return slope >= this->scale * (this->grey[x] + NoiseScaleOffset) &&
      slope > this->Before(x, alongX) && slope >= this->After(x, alongX);
  }

  // The same for four pixels from x on at once: bit k is that of x + k.
  int ArePeaks(int x) const
  {
    const float* squared = this->row.squared.data() + x;
    const cv::v_float32x4 slope = cv::v_load(squared);
    const cv::v_float32x4 least = cv::v_setall_f32(this->scale) *
      (cv::v_load(this->grey + x) + cv::v_setall_f32(NoiseScaleOffset));
    const cv::v_float32x4 alongX =
      cv::v_abs(cv::v_load(&this->row.x[x])) >= cv::v_abs(cv::v_load(&this->row.y[x]));
    const cv::v_float32x4 before =
      cv::v_select(alongX, cv::v_load(squared - 1), cv::v_load(&this->above.squared[x]));
    const cv::v_float32x4 after =
      cv::v_select(alongX, cv::v_load(squared + 1), cv::v_load(&this->below.squared[x]));
    return cv::v_signmask((slope >= least) & (slope > before) & (slope >= after));
  }

  EdgePoint PointAt(int x, int y) const
  {
    const float slope = this->row.squared[x];
    const bool alongX = this->AlongX(x);
    const float offset = PeakOffset(this->Before(x, alongX), slope, this->After(x, alongX));
    return { x + (alongX ? offset : 0), y + (alongX ? 0 : offset), this->row.x[x], this->row.y[x],
      std::sqrt(slope * NoiseScale(this->grey[x])) };
  }
};

// The points of one row where the slope is greatest across the edge; `index` holds the number of
// each pixel's point or -1.
void FindPointsInRow(
  const PeakFinder& finder, int y, int width, std::vector<EdgePoint>& points, int* index)
{
  const auto add = [&](int x)
  {
    index[x] = static_cast<int>(points.size());
    points.push_back(finder.PointAt(x, y));
  };
  int x = 1;
  for (; x + 4 < width; x += 4)
  {
    int peaks = finder.ArePeaks(x);
    for (int k = 0; peaks != 0; ++k, peaks >>= 1)
    {
      if (peaks & 1)
      {
        add(x + k);
      }
    }
  }
  for (; x + 1 < width; ++x)
  {
    if (finder.IsPeak(x))
    {
      add(x);
    }
  }
}

// A point's neighbours are looked for so far from its pixel; the index of points has a frame as wide
// around the image, without any, so that nobody looks over its border.
constexpr int LinkRadius = 2;

std::vector<EdgePoint> FindPoints(const cv::Mat& smooth, double lowContrast, cv::Mat& index)
{
  std::vector<EdgePoint> points;
  points.reserve(smooth.total() / 16);
  index.create(smooth.rows + 2 * LinkRadius, smooth.cols + 2 * LinkRadius, CV_32S);
  index.setTo(-1);
  const float low = static_cast<float>(lowContrast);
  const float scale = low * low / NoiseScaleNumerator;
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
    FindPointsInRow({ smooth.ptr<float>(y), above, row, below, scale }, y, smooth.cols, points,
      index.ptr<int>(y + LinkRadius) + LinkRadius);
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
  static_assert(LinkRadius == 2, "a row of the window is four pixels and one");
  const EdgePoint& point = points[i];
  // The nearest pixel, in the index's frame the window's first one.
  const int x = static_cast<int>(point.x + 0.5), y = static_cast<int>(point.y + 0.5);
  Neighbors best;
  const auto visit = [&](int j)
  {
    const float score = j == i ? 0 : LinkScore(point, points[j]);
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
  };
  for (int v = y; v <= y + 2 * LinkRadius; ++v)
  {
    const int* row = index.ptr<int>(v) + x;
    const int none = cv::v_signmask(cv::v_load(row)) | (row[4] < 0) << 4;
    for (int k = 0, some = ~none & 31; some != 0; ++k, some >>= 1)
    {
      if (some & 1)
      {
        visit(row[k]);
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

  // Goes to a chain; a closed one has no ends and goes on beyond them.
  void GoTo(const std::vector<int>& chain, bool closed)
  {
    const int size = static_cast<int>(chain.size());
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    this->Chain = chain.data();
    this->Size = size;
    this->Closed = closed;
    this->Beyond = closed ? std::min(greatest, (size - 1) / 2) : 0;
    this->Positions.clear();
    for (int k = -this->Beyond; k < size + this->Beyond; ++k)
    {
      const EdgePoint& point = this->Points[chain[k < 0 ? k + size : k < size ? k : k - size]];
      this->Positions.emplace_back(point.x, point.y);
    }
  }

  // The k-th token of the chain.
  EdgeToken Make(int k) const
  {
    const int size = this->Size;
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    const int radius = this->Closed ? this->Beyond : std::min({ greatest, k, size - 1 - k });
    const EdgePoint& center = this->Points[this->Chain[k]];
    const Eigen::Vector2d* positions = this->Positions.data() + this->Beyond;
    EdgeToken token;
    token.contrast = center.contrast;
    token.position = Eigen::Vector2d::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::Zero();
    const double* weights = this->Weights[radius].data() + radius;
    for (int j = -radius; j <= radius; ++j)
    {
      token.position += weights[j] * positions[k + j];
      along += j * positions[k + j];
    }
    if (radius < 2) // at an end
    {
      const int first = std::clamp(k - 2, 0, std::max(0, size - 5));
      along = positions[std::min(first + 4, size - 1)] - positions[first];
    }
    const Eigen::Vector2d level(center.gy, -center.gx); // across the gradient
    token.position += Eigen::Vector2d(0.5, 0.5);
    token.tangent = (along.dot(level) > 0 ? along : level).normalized();
    this->AddColors(token);
    return token;
  }

private:
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

  // The chain at hand.
  const int* Chain = nullptr;
  int Size = 0;
  bool Closed = false;
  int Beyond = 0;                         // how far it goes on beyond its ends, tokens
  std::vector<Eigen::Vector2d> Positions; // with those beyond the ends
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
  TokenMaker maker(points, colors, options.fitRadius);
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
      maker.GoTo(chain, closed);
      for (int k = 0; k < size; ++k)
      {
        edges.tokens.push_back(maker.Make(k));
      }
      edges.begin.push_back(static_cast<int>(edges.tokens.size()));
    });
  return edges;
}

}
