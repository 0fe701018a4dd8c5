// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/EdgeTokens.h"

#include "Common/Error.h"
#include "Edges/ChainKernels.h"
#include "Edges/EdgePixels.h"
#include "Edges/ScanlineKernels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstring>

namespace freespace
{

namespace
{

// Where the colours are taken, pixels from the edge: on the bright side, on the dark one, on itself.
constexpr std::array<float, 9> ColorPlaces{ 1.5f, 2.5f, 3.5f, 5.0f, -1.5f, -2.5f, -3.5f, -5.0f,
  0.0f };

// Weights that give the value of the parabola fitted to 2 * radius + 1 equally spaced values at the
// middle one (Savitzky and Golay). Of three values, too few for a parabola, the mean.
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

// The mean of each pixel and its eight neighbours, so that a single sample stands for its surroundings.
// One byte more stands behind it in memory, so that four can be taken at once.
struct BlurredColors
{
  explicit BlurredColors(const cv::Mat& image);

  ImageLayout layout;
  LargeVector<std::uint8_t> bytes;
};

BlurredColors::BlurredColors(const cv::Mat& image)
  : layout{ image.cols, image.rows, 3 * image.cols }
{
  cv::Mat colors = image;
  if (image.channels() == 1)
  {
    cv::cvtColor(image, colors, cv::COLOR_GRAY2BGR);
  }
  const int width = 3 * colors.cols, last = colors.rows - 1;
  this->bytes.resize(static_cast<std::size_t>(width) * colors.rows + 1);
  std::vector<std::uint16_t> sums(width + 6); // of three rows, with a pixel more at both ends
  for (int y = 0; y <= last; ++y)
  {
    const std::uint8_t* above = colors.ptr<std::uint8_t>(std::max(0, y - 1));
    const std::uint8_t* here = colors.ptr<std::uint8_t>(y);
    const std::uint8_t* below = colors.ptr<std::uint8_t>(std::min(last, y + 1));
    std::uint16_t* sum = sums.data() + 3;
    SumOfThree(above, here, below, width, sum);
    std::copy_n(sum, 3, sum - 3);
    std::copy_n(sum + width - 3, 3, sum + width);
    MeanOfNine(sum, width, &this->bytes[static_cast<std::size_t>(width) * y]);
  }
}

// Turns linked points into tokens, a chain at a time.
class TokenMaker
{
public:
  TokenMaker(const LargeVector<EdgePoint>& points, const BlurredColors& colors, int fitRadius)
    : Points(points)
    , Colors(colors)
  {
    for (int radius = 0; radius <= fitRadius; ++radius)
    {
      this->Weights.push_back({ ParabolaWeights(radius), {} });
      for (int j = -radius; j <= radius; ++j)
      {
        this->Weights.back().slope.push_back(j);
      }
    }
  }

  // Appends the tokens of a chain; a closed one has no ends.
  void Make(const std::vector<int>& chain, bool closed, LargeVector<EdgeToken>& tokens)
  {
    this->GoTo(chain, closed);
    this->Fit();
    Directions(this->AlongX.data(), this->AlongY.data(), this->GradientX.data(),
      this->GradientY.data(), this->Size, this->TangentX.data(), this->TangentY.data());
    for (int k = 0; k < this->Size; ++k)
    {
      // From here on the centre of the first pixel is (0.5, 0.5).
      this->X[k] += 0.5;
      this->Y[k] += 0.5;
    }
    this->FindColors();
    const std::size_t first = tokens.size();
    tokens.resize(first + this->Size);
    for (int k = 0; k < this->Size; ++k)
    {
      EdgeToken& token = tokens[first + k];
      token.position = { this->X[k], this->Y[k] };
      token.tangent = { this->TangentX[k], this->TangentY[k] };
      token.contrast = this->Points[chain[k]].contrast;
      this->AddColors(k, token);
    }
  }

private:
  // The points of a chain; a closed one goes on beyond its ends.
  void GoTo(const std::vector<int>& chain, bool closed)
  {
    const int size = this->Size = static_cast<int>(chain.size());
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    this->Beyond = closed ? std::min(greatest, (size - 1) / 2) : 0;
    this->PointX.resize(size + 2 * this->Beyond);
    this->PointY.resize(size + 2 * this->Beyond);
    for (int k = -this->Beyond; k < size + this->Beyond; ++k)
    {
      const EdgePoint& point = this->Points[chain[k < 0 ? k + size : k < size ? k : k - size]];
      this->PointX[k + this->Beyond] = point.x;
      this->PointY[k + this->Beyond] = point.y;
    }
    this->GradientX.resize(size);
    this->GradientY.resize(size);
    for (int k = 0; k < size; ++k)
    {
      this->GradientX[k] = this->Points[chain[k]].gx;
      this->GradientY[k] = this->Points[chain[k]].gy;
    }
    for (std::vector<double>* values : { &this->X, &this->Y, &this->AlongX, &this->AlongY })
    {
      values->assign(size, 0.0);
    }
    this->TangentX.resize(size);
    this->TangentY.resize(size);
  }

  // The positions and directions by the points around each; near an end there are fewer.
  void Fit()
  {
    const int greatest = static_cast<int>(this->Weights.size()) - 1;
    const int radius = this->Beyond > 0 ? this->Beyond : std::min(greatest, (this->Size - 1) / 2);
    const int ends = this->Beyond > 0 ? 0 : radius;
    this->FitBetween(ends, this->Size - ends, radius);
    for (int k = 0; k < ends; ++k)
    {
      this->FitBetween(k, k + 1, k);
      this->FitBetween(this->Size - 1 - k, this->Size - k, k);
    }
    for (int k = 0; this->Beyond < 2 && k < this->Size; ++k)
    {
      if (radius < 2 || k < 2 || k >= this->Size - 2)
      {
        this->LookAlong(k);
      }
    }
  }

  // The tokens [first, last), each by the points within the radius along the chain.
  void FitBetween(int first, int last, int radius)
  {
    const double* x = this->PointX.data() + this->Beyond + first;
    const double* y = this->PointY.data() + this->Beyond + first;
    const FitWeights& weights = this->Weights[radius];
    AddWeighted(x, last - first, weights.value.data(), radius, &this->X[first]);
    AddWeighted(y, last - first, weights.value.data(), radius, &this->Y[first]);
    AddWeighted(x, last - first, weights.slope.data(), radius, &this->AlongX[first]);
    AddWeighted(y, last - first, weights.slope.data(), radius, &this->AlongY[first]);
  }

  // If a token has too few points around it, its direction is that of the next tokens.
  void LookAlong(int k)
  {
    const int first = std::clamp(k - 2, 0, std::max(0, this->Size - 5));
    const int from = this->Beyond + first, to = this->Beyond + std::min(first + 4, this->Size - 1);
    this->AlongX[k] = this->PointX[to] - this->PointX[from];
    this->AlongY[k] = this->PointY[to] - this->PointY[from];
  }

  void FindColors()
  {
    for (std::size_t place = 0; place < ColorPlaces.size(); ++place)
    {
      this->Offsets[place].resize(this->Size);
      PixelOffsets(this->X.data(), this->Y.data(), this->TangentX.data(), this->TangentY.data(),
        this->Size, ColorPlaces[place], this->Colors.layout, this->Offsets[place].data());
    }
  }

  void AddColors(int k, EdgeToken& token) const
  {
    for (int place = 0; place < 4; ++place)
    {
      token.bright[place] = this->ColorAt(this->Offsets[place][k]);
      token.dark[place] = this->ColorAt(this->Offsets[4 + place][k]);
    }
    token.color = this->ColorAt(this->Offsets[8][k]);
  }

  // Four bytes at once; the one after the colour is there, see BlurredColors.
  EdgeColor ColorAt(int offset) const
  {
    constexpr EdgeColor channels{ 255, 255, 255, 0 };
    std::uint32_t four, mask;
    std::memcpy(&four, this->Colors.bytes.data() + offset, sizeof four);
    std::memcpy(&mask, channels.data(), sizeof mask);
    four &= mask;
    EdgeColor color;
    std::memcpy(color.data(), &four, color.size());
    return color;
  }

  struct FitWeights
  {
    std::vector<double> value, slope;
  };

  const LargeVector<EdgePoint>& Points;
  const BlurredColors& Colors;
  std::vector<FitWeights> Weights; // by radius

  // The chain at hand.
  int Size = 0;
  int Beyond = 0;                     // how far it goes on beyond its ends, points
  std::vector<double> PointX, PointY; // with those beyond the ends
  std::vector<float> GradientX, GradientY;
  std::vector<double> X, Y, AlongX, AlongY, TangentX, TangentY;
  std::array<std::vector<int>, ColorPlaces.size()> Offsets; // of the pixels with the colours
};

// Follows the links from each chain's first point, then around the closed chains.
template <typename Visitor>
void VisitChains(const LinkedPoints& edges, Visitor&& visit)
{
  const int count = static_cast<int>(edges.points.size());
  std::vector<char> taken(count, 0);
  std::vector<int> chain;
  for (const bool closed : { false, true })
  {
    for (int start = 0; start < count; ++start)
    {
      if (taken[start] || (!closed && edges.previous[start] >= 0))
      {
        continue;
      }
      chain.clear();
      for (int i = start; i >= 0 && !taken[i]; i = edges.next[i])
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
  const LinkedPoints points = FindEdgePixels(image, options.smoothing, options.lowContrast);
  const BlurredColors colors(image);
  TokenMaker maker(points.points, colors, options.fitRadius);
  edges.tokens.reserve(points.points.size());
  VisitChains(points,
    [&](const std::vector<int>& chain, bool closed)
    {
      const bool strong = std::any_of(chain.begin(), chain.end(),
        [&](int i) { return points.points[i].contrast >= options.highContrast; });
      if (!strong || static_cast<int>(chain.size()) < options.minimumLength)
      {
        return;
      }
      maker.Make(chain, closed, edges.tokens);
      edges.begin.push_back(static_cast<int>(edges.tokens.size()));
    });
  return edges;
}

}
