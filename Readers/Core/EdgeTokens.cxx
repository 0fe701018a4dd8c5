// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeTokens.h"

#include "Error.h"

#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace freespace
{

namespace
{

// Where the colours of a side are taken, pixels from the edge.
constexpr float SideDistances[4] = { 1.5f, 2.5f, 3.5f, 5.0f };

// An edge pixel whose position is known to a fraction of a pixel (first pixel centre at 0, 0).
struct EdgePoint
{
  float x, y;
  float gx, gy;   // gradient, grey levels per pixel
  float contrast; // its length, in the noise of middle grey
  int next = -1, previous = -1;
};

// The grey levels of an image, smoothed by a Gaussian, one row at a time.
class SmoothRows
{
public:
  SmoothRows(const cv::Mat& image, double sigma)
    : Radius(static_cast<int>(std::ceil(2.5 * sigma)))
  {
    if (image.channels() == 3)
    {
      cv::cvtColor(image, this->Grey, cv::COLOR_BGR2GRAY);
    }
    else
    {
      this->Grey = image;
    }
    const cv::Mat kernel = cv::getGaussianKernel(2 * this->Radius + 1, sigma, CV_32F);
    this->Weights.assign(kernel.ptr<float>(this->Radius), kernel.ptr<float>(0) + kernel.total());
    this->Vertical.resize(this->Grey.cols + 2 * this->Radius);
  }

  // Beyond the border, the image goes on as it ends.
  void Compute(int row, float* smooth)
  {
    const int width = this->Grey.cols, last = this->Grey.rows - 1;
    float* middle = this->Vertical.data() + this->Radius;
    const std::uint8_t* grey = this->Grey.ptr<std::uint8_t>(row);
    for (int x = 0; x < width; ++x)
    {
      middle[x] = this->Weights[0] * grey[x];
    }
    for (int k = 1; k <= this->Radius; ++k)
    {
      const std::uint8_t* above = this->Grey.ptr<std::uint8_t>(std::max(0, row - k));
      const std::uint8_t* below = this->Grey.ptr<std::uint8_t>(std::min(last, row + k));
      const float weight = this->Weights[k];
      for (int x = 0; x < width; ++x)
      {
        middle[x] += weight * (above[x] + below[x]);
      }
    }
    std::fill(this->Vertical.data(), middle, middle[0]);
    std::fill(middle + width, middle + width + this->Radius, middle[width - 1]);
    for (int x = 0; x < width; ++x)
    {
      smooth[x] = this->Weights[0] * middle[x];
    }
    for (int k = 1; k <= this->Radius; ++k)
    {
      const float weight = this->Weights[k];
      for (int x = 0; x < width; ++x)
      {
        smooth[x] += weight * (middle[x - k] + middle[x + k]);
      }
    }
  }

private:
  int Radius;
  cv::Mat Grey;
  std::vector<float> Weights;  // from the middle outwards
  std::vector<float> Vertical; // a row smoothed across rows only, with its border
};

// A row of smoothed grey levels, their central differences and the squared slope, which stay zero in
// the first and last pixel.
struct GradientRow
{
  explicit GradientRow(int width)
    : grey(width, 0.0f)
    , x(width, 0.0f)
    , y(width, 0.0f)
    , squared(width, 0.0f)
  {
  }

  void Compute(const GradientRow& above, const GradientRow& below)
  {
    const float *up = above.grey.data(), *here = this->grey.data(), *down = below.grey.data();
    const int last = static_cast<int>(this->grey.size()) - 1;
    float *gx = this->x.data(), *gy = this->y.data(), *slope = this->squared.data();
    const cv::v_float32x4 half = cv::v_setall_f32(0.5f);
    int i = 1;
    for (; i + 4 <= last; i += 4)
    {
      const cv::v_float32x4 dx = half * (cv::v_load(here + i + 1) - cv::v_load(here + i - 1));
      const cv::v_float32x4 dy = half * (cv::v_load(down + i) - cv::v_load(up + i));
      cv::v_store(gx + i, dx);
      cv::v_store(gy + i, dy);
      cv::v_store(slope + i, dx * dx + dy * dy);
    }
    for (; i < last; ++i)
    {
      gx[i] = 0.5f * (here[i + 1] - here[i - 1]);
      gy[i] = 0.5f * (down[i] - up[i]);
      slope[i] = gx[i] * gx[i] + gy[i] * gy[i];
    }
  }

  void Clear()
  {
    std::fill(this->x.begin(), this->x.end(), 0.0f);
    std::fill(this->y.begin(), this->y.end(), 0.0f);
    std::fill(this->squared.begin(), this->squared.end(), 0.0f);
  }

  std::vector<float> grey, x, y, squared;
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
    return slope >= this->scale * (this->row.grey[x] + NoiseScaleOffset) &&
      slope > this->Before(x, alongX) && slope >= this->After(x, alongX);
  }

  // The same for four pixels from x on at once: bit k is that of x + k.
  int ArePeaks(int x) const
  {
    const float* squared = this->row.squared.data() + x;
    const cv::v_float32x4 slope = cv::v_load(squared);
    const cv::v_float32x4 least = cv::v_setall_f32(this->scale) *
      (cv::v_load(&this->row.grey[x]) + cv::v_setall_f32(NoiseScaleOffset));
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
      std::sqrt(slope * NoiseScale(this->row.grey[x])) };
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

// A point's neighbours are looked for so far from its pixel.
constexpr int LinkRadius = 2;

// The number of the point in each pixel, or -1, of the last rows. A frame around the image has no
// points, so that nobody looks over its border.
class PointIndex
{
public:
  explicit PointIndex(int width)
  {
    for (std::vector<int>& row : this->Rows)
    {
      row.assign(width + 2 * LinkRadius + 1, -1);
    }
  }

  // A row of which nothing is known, starting at its first pixel. It takes the place of an old one.
  int* Begin(int y)
  {
    std::vector<int>& row = this->Rows[y & (Kept - 1)];
    std::fill(row.begin(), row.end(), -1);
    return row.data() + LinkRadius;
  }

  // The pixels of row y from x - LinkRadius on.
  const int* Window(int x, int y) const { return this->Rows[y & (Kept - 1)].data() + x; }

private:
  static constexpr int Kept = 8;
  std::array<std::vector<int>, Kept> Rows;
};

// The squared distance to a point that goes on with the edge, positive when it lies ahead (the gradient
// pointing to the right), negative behind; NoLink when the two do not belong together.
constexpr float NoLink = std::numeric_limits<float>::max();
float LinkDistance(const EdgePoint& from, const EdgePoint& to)
{
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float along = dx * from.gy - dy * from.gx, alongTo = dx * to.gy - dy * to.gx;
  // No branches: which way it goes cannot be foretold.
  const bool linked = (from.gx * to.gx + from.gy * to.gy > 0) & (along * alongTo > 0);
  const float squared = dx * dx + dy * dy;
  const float distance = along > 0 ? squared : -squared;
  return linked ? distance : NoLink;
}

// The nearest points ahead of and behind a point, at most two pixels around it.
struct Neighbors
{
  int ahead = -1, behind = -1;
  float aheadDistance = NoLink, behindDistance = -NoLink;
};

Neighbors FindNeighbors(const std::vector<EdgePoint>& points, const PointIndex& index, int i)
{
  static_assert(LinkRadius == 2, "a row of the window is four pixels and one");
  constexpr int size = 2 * LinkRadius + 1;
  const EdgePoint& point = points[i];
  const int x = static_cast<int>(point.x + 0.5f), y = static_cast<int>(point.y + 0.5f);
  const int* rows[size];
  unsigned none = 0; // a bit for each pixel of the window without a point
  for (int k = 0; k < size; ++k)
  {
    rows[k] = index.Window(x, y + k - LinkRadius);
    none |= static_cast<unsigned>(cv::v_signmask(cv::v_load(rows[k])) | (rows[k][4] < 0) << 4)
      << size * k;
  }
  Neighbors best;
  for (unsigned some = ~none & ((1u << size * size) - 1); some != 0; some &= some - 1)
  {
    const int bit = static_cast<int>(trailingZeros32(some));
    const int j = rows[bit / size][bit % size];
    // The point itself lies neither ahead nor behind.
    const float distance = LinkDistance(point, points[j]);
    const bool ahead = (distance > 0) & (distance < best.aheadDistance);
    const bool behind = (distance < 0) & (distance > best.behindDistance);
    best.ahead = ahead ? j : best.ahead;
    best.aheadDistance = ahead ? distance : best.aheadDistance;
    best.behind = behind ? j : best.behind;
    best.behindDistance = behind ? distance : best.behindDistance;
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

// Links a point to the best one ahead and behind; a point that two want goes to the nearer.
void LinkToNeighbors(std::vector<EdgePoint>& points, const PointIndex& index, int i)
{
  const Neighbors best = FindNeighbors(points, index, i);
  if (best.ahead >= 0 && points[i].next != best.ahead)
  {
    const int rival = points[best.ahead].previous;
    if (rival < 0 || LinkDistance(points[rival], points[best.ahead]) > best.aheadDistance)
    {
      Link(points, i, best.ahead);
    }
  }
  if (best.behind >= 0 && points[i].previous != best.behind)
  {
    const int rival = points[best.behind].next;
    if (rival < 0 || LinkDistance(points[rival], points[best.behind]) < best.behindDistance)
    {
      Link(points, best.behind, i);
    }
  }
}

// The points where the slope is greatest across the edge, row by row, linked. Only as much of the
// image is kept at a time as the next point needs.
std::vector<EdgePoint> FindLinkedPoints(const cv::Mat& image, const EdgeTokenOptions& options)
{
  const int width = image.cols, height = image.rows;
  const float low = static_cast<float>(options.lowContrast);
  const float scale = low * low / NoiseScaleNumerator;
  SmoothRows smooth(image, options.smoothing);
  PointIndex index(width);
  std::vector<EdgePoint> points;
  points.reserve(image.total() / 16);
  // Rows y - 1 .. y + 2 when those of y are found; the slopes need the grey levels of the next.
  std::array<GradientRow, 4> rows{ GradientRow(width), GradientRow(width), GradientRow(width),
    GradientRow(width) };
  const auto rowAt = [&rows](int y) -> GradientRow& { return rows[y & 3]; };
  for (int y = 0; y < 3; ++y)
  {
    smooth.Compute(y, rowAt(y).grey.data());
  }
  rowAt(1).Compute(rowAt(0), rowAt(2));
  constexpr int ahead = LinkRadius + 1; // a point may lie half a pixel off its own
  std::array<int, 8> firstInRow{};      // its first point
  int linked = 0;
  for (int y = 0; y < height + ahead; ++y)
  {
    firstInRow[y & 7] = static_cast<int>(points.size());
    int* pixels = index.Begin(y);
    if (y > 0 && y + 1 < height)
    {
      if (y + 2 < height)
      {
        smooth.Compute(y + 2, rowAt(y + 2).grey.data());
        rowAt(y + 1).Compute(rowAt(y), rowAt(y + 2));
      }
      else
      {
        rowAt(y + 1).Clear();
      }
      FindPointsInRow({ rowAt(y - 1), rowAt(y), rowAt(y + 1), scale }, y, width, points, pixels);
    }
    for (const int end = firstInRow[(y - ahead + 1) & 7]; y >= ahead && linked < end; ++linked)
    {
      LinkToNeighbors(points, index, linked);
    }
  }
  return points;
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
  void Make(int k, EdgeToken& token) const
  {
    const int size = this->Size;
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    const int radius = this->Closed ? this->Beyond : std::min({ greatest, k, size - 1 - k });
    const EdgePoint& center = this->Points[this->Chain[k]];
    const Eigen::Vector2d* positions = this->Positions.data() + this->Beyond;
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
  }

private:
  void AddColors(EdgeToken& token) const
  {
    const cv::v_float32x4 distance = cv::v_load(SideDistances);
    const cv::v_float32x4 x = cv::v_setall_f32(static_cast<float>(token.position.x()));
    const cv::v_float32x4 y = cv::v_setall_f32(static_cast<float>(token.position.y()));
    const Eigen::Vector2d normal = token.Normal();
    const cv::v_float32x4 dx = distance * cv::v_setall_f32(static_cast<float>(normal.x()));
    const cv::v_float32x4 dy = distance * cv::v_setall_f32(static_cast<float>(normal.y()));
    this->CopyColors(x + dx, y + dy, token.bright);
    this->CopyColors(x - dx, y - dy, token.dark);
    this->CopyColor(
      static_cast<int>(token.position.x()), static_cast<int>(token.position.y()), token.color);
  }

  void CopyColors(const cv::v_float32x4& x, const cv::v_float32x4& y, EdgeSide& side) const
  {
    int columns[4], rows[4];
    cv::v_store(columns, cv::v_trunc(x));
    cv::v_store(rows, cv::v_trunc(y));
    for (int k = 0; k < 4; ++k)
    {
      this->CopyColor(columns[k], rows[k], side[k]);
    }
  }

  void CopyColor(int column, int row, EdgeColor& color) const
  {
    const int x = std::clamp(column, 0, this->Colors.cols - 1);
    const int y = std::clamp(row, 0, this->Colors.rows - 1);
    // Four bytes at once; the one after the colour is there, see BlurredColors.
    std::memcpy(color.data(), this->Colors.ptr<std::uint8_t>(y) + 3 * x, color.size());
    color[3] = 0;
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

void AddRows(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
  int width, std::uint16_t* sum)
{
  int i = 0;
  for (; i + 8 <= width; i += 8)
  {
    cv::v_store(sum + i,
      cv::v_load_expand(above + i) + cv::v_load_expand(here + i) + cv::v_load_expand(below + i));
  }
  for (; i < width; ++i)
  {
    sum[i] = static_cast<std::uint16_t>(above[i] + here[i] + below[i]);
  }
}

// A ninth of three neighbouring sums, three channels apart, rounded.
void MeanOfNine(const std::uint16_t* sum, int width, std::uint8_t* mean)
{
  constexpr std::uint16_t ninth = 65536 / 9 + 1, half = 4;
  int i = 0;
  for (; i + 8 <= width; i += 8)
  {
    const cv::v_uint16x8 nine = cv::v_load(sum + i - 3) + cv::v_load(sum + i) +
      cv::v_load(sum + i + 3) + cv::v_setall_u16(half);
    cv::v_pack_store(mean + i, cv::v_mul_hi(nine, cv::v_setall_u16(ninth)));
  }
  for (; i < width; ++i)
  {
    const unsigned nine = sum[i - 3] + sum[i] + sum[i + 3] + half;
    mean[i] = static_cast<std::uint8_t>(nine * ninth >> 16);
  }
}

// The mean of each pixel and its eight neighbours, so that a single sample stands for its surroundings.
// Below the image stands a row more in memory.
cv::Mat BlurredColors(const cv::Mat& image)
{
  cv::Mat colors = image;
  if (image.channels() == 1)
  {
    cv::cvtColor(image, colors, cv::COLOR_GRAY2BGR);
  }
  const int width = 3 * colors.cols, last = colors.rows - 1;
  const cv::Mat padded(colors.rows + 1, colors.cols, CV_8UC3);
  cv::Mat blurred = padded.rowRange(0, colors.rows);
  std::vector<std::uint16_t> sums(width + 6); // of three rows, with a pixel more at both ends
  for (int y = 0; y <= last; ++y)
  {
    const std::uint8_t* above = colors.ptr<std::uint8_t>(std::max(0, y - 1));
    const std::uint8_t* here = colors.ptr<std::uint8_t>(y);
    const std::uint8_t* below = colors.ptr<std::uint8_t>(std::min(last, y + 1));
    std::uint16_t* sum = sums.data() + 3;
    AddRows(above, here, below, width, sum);
    std::copy_n(sum, 3, sum - 3);
    std::copy_n(sum + width - 3, 3, sum + width);
    MeanOfNine(sum, width, blurred.ptr<std::uint8_t>(y));
  }
  return blurred;
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
  const std::vector<EdgePoint> points = FindLinkedPoints(image, options);

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
        edges.tokens.emplace_back();
        maker.Make(k, edges.tokens.back());
      }
      edges.begin.push_back(static_cast<int>(edges.tokens.size()));
    });
  return edges;
}

}
