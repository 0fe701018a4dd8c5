// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/EdgePixels.h"

#include "Edges/LowestBit.h"
#include "Edges/ScanlineKernels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace freespace
{

namespace
{

// The grey levels of an image, row after row. Only the last ones are kept.
class GreyRows
{
public:
  // The rows that are asked for at a time are `most` neighbours.
  GreyRows(const cv::Mat& image, int most)
    : Image(image)
    , Strip(std::max(16, most))
  {
    if (image.channels() == 3)
    {
      this->Grey.create(Strips * this->Strip, image.cols, CV_8U);
    }
  }

  const std::uint8_t* At(int y)
  {
    if (this->Image.channels() != 3)
    {
      return this->Image.ptr<std::uint8_t>(y);
    }
    while (y >= this->Converted)
    {
      const int end = std::min(this->Converted + this->Strip, this->Image.rows);
      const int place = this->PlaceOf(this->Converted);
      cv::Mat strip = this->Grey.rowRange(place, place + end - this->Converted);
      cv::cvtColor(this->Image.rowRange(this->Converted, end), strip, cv::COLOR_BGR2GRAY);
      this->Converted = end;
    }
    return this->Grey.ptr<std::uint8_t>(this->PlaceOf(y));
  }

private:
  static constexpr int Strips = 3; // the one at hand and those of the rows above and below

  int PlaceOf(int y) const { return y % (Strips * this->Strip); }

  const cv::Mat& Image;
  int Strip; // rows
  cv::Mat Grey;
  int Converted = 0; // rows
};

// The grey levels of an image, smoothed by a Gaussian, one row at a time.
class SmoothRows
{
public:
  SmoothRows(const cv::Mat& image, double sigma)
    : Radius(static_cast<int>(std::ceil(2.5 * sigma)))
    , Width(image.cols)
    , Last(image.rows - 1)
    , Grey(image, 2 * this->Radius + 1)
  {
    const cv::Mat kernel = cv::getGaussianKernel(2 * this->Radius + 1, sigma, CV_32F);
    this->Weights.assign(kernel.ptr<float>(this->Radius), kernel.ptr<float>(0) + kernel.total());
    this->Rows.resize(kernel.total());
    this->Work.resize(this->Width + 2 * this->Radius);
  }

  // Row after row, from the first one on. Beyond the border, the last pixels are repeated.
  void Compute(int row, float* smooth)
  {
    for (int k = -this->Radius; k <= this->Radius; ++k)
    {
      this->Rows[k + this->Radius] = this->Grey.At(std::clamp(row + k, 0, this->Last));
    }
    SmoothRow(this->Rows.data(), this->Weights.data(), this->Radius, this->Width, this->Work.data(),
      smooth);
  }

private:
  int Radius, Width, Last;
  GreyRows Grey;
  std::vector<float> Weights; // from the middle outwards
  std::vector<const std::uint8_t*> Rows;
  std::vector<float> Work;
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
    SlopeRow(above.grey.data(), this->grey.data(), below.grey.data(),
      static_cast<int>(this->grey.size()), this->x.data(), this->y.data(), this->squared.data());
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

// Vertex of the parabola through the slopes at -1, 0 and 1, the middle one being the largest. For a
// step over square pixels and central differences it is exact.
float PeakOffset(float a, float b, float c)
{
  const float curvature = a - 2 * b + c;
  return curvature < 0 ? 0.5f * (a - c) / curvature : 0.0f;
}

// Three rows of slopes, the middle one with a peak.
struct PeakRow
{
  const GradientRow &above, &row, &below;

  EdgePoint PointAt(int x, int y) const
  {
    const float slope = this->row.squared[x], gx = this->row.x[x], gy = this->row.y[x];
    const bool alongX = std::abs(gx) >= std::abs(gy);
    const float before = alongX ? this->row.squared[x - 1] : this->above.squared[x];
    const float after = alongX ? this->row.squared[x + 1] : this->below.squared[x];
    // All roots at once.
    std::array<float, 4> roots{ before, slope, after, slope * NoiseScale(this->row.grey[x]) };
    for (float& root : roots)
    {
      root = std::sqrt(root);
    }
    const float offset = PeakOffset(roots[0], roots[1], roots[2]);
    return { x + (alongX ? offset : 0), y + (alongX ? 0 : offset), gx, gy, roots[3] };
  }
};

// Radius, in pixels, of the search for the neighbours of a point.
constexpr int LinkRadius = 2;

// The points' pixels of the last rows, and their numbers. A margin around the image has no points,
// so that nobody looks over its border.
class PointIndex
{
public:
  explicit PointIndex(int width)
    : Width(width)
  {
    const std::size_t pixels = static_cast<std::size_t>(std::max(width, 0)) + 2 * LinkRadius;
    for (Row& row : this->Rows)
    {
      row.marks.assign(pixels + sizeof(std::uint64_t), 0);
      row.numbers.resize(pixels);
    }
  }

  // A row without points, which takes the place of an old one.
  void Begin(int y)
  {
    Row& row = this->At(y);
    std::fill(row.marks.begin(), row.marks.end(), 0);
    row.columns.clear();
  }

  // One for each pixel of row y, to be marked.
  std::uint8_t* Marks(int y) { return this->At(y).marks.data() + LinkRadius; }

  // Calls visit(x) for each marked pixel of row y; its point has the number that this returns.
  template <typename Visitor>
  void Number(int y, Visitor&& visit)
  {
    Row& row = this->At(y);
    const std::uint8_t* marks = row.marks.data() + LinkRadius;
    for (int x = 0; x < this->Width; x += 8)
    {
      for (std::uint64_t some = Load(marks + x); some != 0; some &= some - 1)
      {
        const int column = x + LowestBit(some) / 8;
        row.numbers[column + LinkRadius] = visit(column);
        row.columns.push_back(column);
      }
    }
  }

  // The pixels of row y that have points, from left to right.
  const std::vector<int>& Columns(int y) const { return this->Rows[y & (Kept - 1)].columns; }

  // A bit for each pixel around one: 8 * column + row, from x - LinkRadius and y - LinkRadius on.
  std::uint64_t Window(int x, int y) const
  {
    std::uint64_t window = 0;
    for (int row = 0; row <= 2 * LinkRadius; ++row)
    {
      window |= Load(&this->Rows[(y + row - LinkRadius) & (Kept - 1)].marks[x]) << row;
    }
    return window;
  }

  // The number of the point in a bit of the window around (x, y).
  int InWindow(int x, int y, int bit) const
  {
    return this->Rows[(y + bit % 8 - LinkRadius) & (Kept - 1)].numbers[x + bit / 8];
  }

private:
  static constexpr int Kept = 8;
  struct Row
  {
    std::vector<std::uint8_t> marks; // 1 where there is a point
    std::vector<int> numbers;        // of the points, meaningless elsewhere
    std::vector<int> columns;
  };

  Row& At(int y) { return this->Rows[y & (Kept - 1)]; }

  // Eight marks, the first one lowest.
  static std::uint64_t Load(const std::uint8_t* marks)
  {
    std::uint64_t eight = 0; // the compiler makes it one load
    for (int k = 0; k < 8; ++k)
    {
      eight |= static_cast<std::uint64_t>(marks[k]) << 8 * k;
    }
    return eight;
  }

  int Width;
  std::array<Row, Kept> Rows;
};

// The squared distance to a point that goes on with the edge, positive when it lies ahead (the gradient
// pointing to the right), negative behind; NoLink when the two do not belong together.
constexpr float NoLink = std::numeric_limits<float>::max();
float LinkDistance(const EdgePoint& from, const EdgePoint& to)
{
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float along = dx * from.gy - dy * from.gx, alongTo = dx * to.gy - dy * to.gx;
  // Without branches, which could not be predicted.
  const bool linked = (from.gx * to.gx + from.gy * to.gy > 0) & (along * alongTo > 0);
  const float squared = dx * dx + dy * dy;
  const float distance = along > 0 ? squared : -squared;
  return linked ? distance : NoLink;
}

// The nearest points ahead of and behind a point.
struct Neighbors
{
  int ahead = -1, behind = -1;
  float aheadDistance = NoLink, behindDistance = -NoLink;

  void Add(const LargeVector<EdgePoint>& points, int i, int j)
  {
    const float distance = LinkDistance(points[i], points[j]);
    const bool nearerAhead = (distance > 0) & (distance < this->aheadDistance);
    const bool nearerBehind = (distance < 0) & (distance > this->behindDistance);
    this->ahead = nearerAhead ? j : this->ahead;
    this->aheadDistance = nearerAhead ? distance : this->aheadDistance;
    this->behind = nearerBehind ? j : this->behind;
    this->behindDistance = nearerBehind ? distance : this->behindDistance;
  }
};

// Those of point i in the pixel (x, y): next to it or, where there is none, a pixel farther.
Neighbors FindNeighbors(
  const LargeVector<EdgePoint>& points, const PointIndex& index, int x, int y, int i)
{
  static_assert(LinkRadius == 2, "the bits of a window of five pixels");
  constexpr std::uint64_t whole = 0x1f1f1f1f1f, next = 0x0e0a0e00, middle = 0x040000;
  const std::uint64_t window = index.Window(x, y);
  Neighbors best;
  for (const std::uint64_t ring : { next, whole & ~next & ~middle })
  {
    for (std::uint64_t some = window & ring; some != 0; some &= some - 1)
    {
      best.Add(points, i, index.InWindow(x, y, LowestBit(some)));
    }
    if (best.ahead >= 0 && best.behind >= 0)
    {
      break;
    }
  }
  return best;
}

void Link(LinkedPoints& edges, int from, int to)
{
  int &next = edges.next[from], &previous = edges.previous[to];
  if (next >= 0)
  {
    edges.previous[next] = -1;
  }
  if (previous >= 0)
  {
    edges.next[previous] = -1;
  }
  next = to;
  previous = from;
}

// Links a point to the best one ahead and behind; of two candidates for one link the nearer wins.
void LinkToNeighbors(LinkedPoints& edges, const Neighbors& best, int i)
{
  const LargeVector<EdgePoint>& points = edges.points;
  if (best.ahead >= 0 && edges.next[i] != best.ahead)
  {
    const int rival = edges.previous[best.ahead];
    if (rival < 0 || LinkDistance(points[rival], points[best.ahead]) > best.aheadDistance)
    {
      Link(edges, i, best.ahead);
    }
  }
  if (best.behind >= 0 && edges.previous[i] != best.behind)
  {
    const int rival = edges.next[best.behind];
    if (rival < 0 || LinkDistance(points[rival], points[best.behind]) < best.behindDistance)
    {
      Link(edges, best.behind, i);
    }
  }
}

// The rows of an image around the current one.
class EdgeFinder
{
public:
  EdgeFinder(const cv::Mat& image, double smoothing, double lowContrast)
    : Width(image.cols)
    , Height(image.rows)
    , Scale(static_cast<float>(lowContrast * lowContrast) / NoiseScaleNumerator)
    , Smooth(image, smoothing)
    , Rows{ GradientRow(image.cols), GradientRow(image.cols), GradientRow(image.cols),
      GradientRow(image.cols) }
    , Index(image.cols)
  {
    const std::size_t many = image.total() / 8; // what is not needed is not touched
    this->Edges.points.reserve(many);
    this->Edges.next.reserve(many);
    this->Edges.previous.reserve(many);
  }

  LinkedPoints Find()
  {
    for (int y = 0; y < 3; ++y)
    {
      this->Smooth.Compute(y, this->RowAt(y).grey.data());
    }
    this->RowAt(1).Compute(this->RowAt(0), this->RowAt(2));
    for (int y = 0; y < this->Height + LinkRadius; ++y)
    {
      this->Index.Begin(y);
      if (y > 0 && y + 1 < this->Height)
      {
        this->FindPoints(y);
      }
      if (y >= LinkRadius)
      {
        this->LinkPoints(y - LinkRadius);
      }
    }
    return std::move(this->Edges);
  }

private:
  GradientRow& RowAt(int y) { return this->Rows[y & 3]; }

  // The points of row y. Rows y - 1 .. y + 2 are at hand then; the slopes need the grey levels of
  // the next.
  void FindPoints(int y)
  {
    if (y + 2 < this->Height)
    {
      this->Smooth.Compute(y + 2, this->RowAt(y + 2).grey.data());
      this->RowAt(y + 1).Compute(this->RowAt(y), this->RowAt(y + 2));
    }
    else
    {
      this->RowAt(y + 1).Clear();
    }
    const PeakRow peaks{ this->RowAt(y - 1), this->RowAt(y), this->RowAt(y + 1) };
    MarkPeaks({ peaks.above.squared.data(), peaks.row.squared.data(), peaks.below.squared.data(),
                peaks.row.x.data(), peaks.row.y.data(), peaks.row.grey.data() },
      this->Width, this->Scale, NoiseScaleOffset, this->Index.Marks(y));
    this->Index.Number(y,
      [&](int x)
      {
        this->Edges.points.push_back(peaks.PointAt(x, y));
        return static_cast<int>(this->Edges.points.size()) - 1;
      });
    this->Edges.next.resize(this->Edges.points.size(), -1);
    this->Edges.previous.resize(this->Edges.points.size(), -1);
  }

  void LinkPoints(int y)
  {
    for (const int x : this->Index.Columns(y))
    {
      const Neighbors best = FindNeighbors(this->Edges.points, this->Index, x, y, this->Linked);
      LinkToNeighbors(this->Edges, best, this->Linked);
      ++this->Linked;
    }
  }

  int Width, Height;
  float Scale; // least squared slope for each grey level
  SmoothRows Smooth;
  std::array<GradientRow, 4> Rows;
  PointIndex Index;
  LinkedPoints Edges;
  int Linked = 0; // points
};

}

LinkedPoints FindEdgePixels(const cv::Mat& image, double smoothing, double lowContrast)
{
  if (image.rows < 3 || image.cols < 3)
  {
    return {};
  }
  return EdgeFinder(image, smoothing, lowContrast).Find();
}

}
