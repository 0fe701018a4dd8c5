// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/EdgeTokens.h"

#include "Common/Error.h"
#include "Support/SyntheticImages.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

constexpr double pi = 3.14159265358979323846;

// An image of 120 x 100 pixels that is bright where the function is positive.
cv::Mat Image(
  const std::function<double(double x, double y)>& bright, double low = 40, double high = 200)
{
  Camera camera;
  camera.width = 120;
  camera.height = 100;
  Layer plane;
  plane.exists = Everywhere();
  plane.color = [=](double x, double y)
  {
    const double level = bright(x, y) > 0 ? high : low;
    return Eigen::Vector3d(level, level, level);
  };
  return Render({ plane }, camera); // K is the identity: x and y are pixels
}

struct Line
{
  double degrees;
  double offset;

  Eigen::Vector2d Normal() const
  {
    return { -std::sin(degrees * pi / 180), std::cos(degrees * pi / 180) };
  }
  double operator()(double x, double y) const
  {
    return this->Normal().dot(Eigen::Vector2d(x - 60, y - 50)) - this->offset;
  }
};

}

TEST(EdgeTokens, LineAtAnyAngleHasNoBias)
{
  for (double degrees = 0; degrees < 360; degrees += 7.5)
  {
    const Line line{ degrees, 0.013 * degrees };
    const EdgeChains edges = FindEdges(Image(line), EdgeTokenOptions());
    ASSERT_EQ(edges.NumberOfChains(), 1u) << degrees;
    double sum = 0, squares = 0;
    for (const EdgeToken& token : edges.tokens)
    {
      const double off = line(token.position.x(), token.position.y());
      sum += off;
      squares += off * off;
      EXPECT_GT(token.Normal().dot(line.Normal()), std::cos(6 * pi / 180)) << degrees;
    }
    const double count = static_cast<double>(edges.tokens.size());
    EXPECT_GT(count, 85) << degrees;
    EXPECT_LT(std::abs(sum / count), 0.015) << degrees;
    EXPECT_LT(std::sqrt(squares / count), 0.05) << degrees;
  }
}

TEST(EdgeTokens, CircleIsOneClosedChain)
{
  const auto circle = [](double x, double y) { return 30 - std::hypot(x - 61.3, y - 48.8); };
  const EdgeChains edges = FindEdges(Image(circle), EdgeTokenOptions());
  ASSERT_EQ(edges.NumberOfChains(), 1u);
  for (std::size_t i = 0; i < edges.tokens.size(); ++i)
  {
    const EdgeToken& token = edges.tokens[i];
    EXPECT_LT(std::abs(circle(token.position.x(), token.position.y())), 0.15);
    const EdgeToken& next = edges.tokens[(i + 1) % edges.tokens.size()];
    EXPECT_LT((next.position - token.position).norm(), 2);
    EXPECT_GT(token.tangent.dot(next.position - token.position), 0);
    EXPECT_GT(token.bright[0][0], token.dark[0][0]);
  }
}

TEST(EdgeTokens, ColorsOfBothSides)
{
  Camera camera;
  camera.width = 60;
  camera.height = 40;
  Layer plane;
  plane.exists = Everywhere();
  plane.color = [](double x, double)
  { return x > 30.4 ? Eigen::Vector3d(20, 180, 90) : Eigen::Vector3d(90, 10, 40); };
  const EdgeChains edges = FindEdges(Render({ plane }, camera), EdgeTokenOptions());
  ASSERT_EQ(edges.NumberOfChains(), 1u);
  for (const EdgeToken& token : edges.tokens)
  {
    for (int sample = 1; sample < 4; ++sample) // the nearest one is blurred with the other side
    {
      EXPECT_EQ(token.bright[sample][0], 20);
      EXPECT_EQ(token.bright[sample][1], 180);
      EXPECT_EQ(token.bright[sample][2], 90);
      EXPECT_EQ(token.dark[sample][0], 90);
      EXPECT_EQ(token.dark[sample][1], 10);
      EXPECT_EQ(token.dark[sample][2], 40);
    }
  }
}

TEST(EdgeTokens, ContrastDecides)
{
  const Line line{ 90, 0 };
  EXPECT_EQ(FindEdges(Image(line, 120, 122), EdgeTokenOptions()).tokens.size(), 0u);
  EXPECT_GT(FindEdges(Image(line, 110, 135), EdgeTokenOptions()).tokens.size(), 90u);
  // In the dark, where there is less noise, less will do.
  EXPECT_GT(FindEdges(Image(line, 10, 17), EdgeTokenOptions()).tokens.size(), 90u);
  EXPECT_EQ(FindEdges(Image(line, 240, 247), EdgeTokenOptions()).tokens.size(), 0u);
}

TEST(EdgeTokens, ShortChainsAreDropped)
{
  const auto dot = [](double x, double y) { return 1.5 - std::hypot(x - 60, y - 50); };
  EdgeTokenOptions options;
  EXPECT_GT(FindEdges(Image(dot), options).tokens.size(), 0u);
  options.minimumLength = 30;
  EXPECT_EQ(FindEdges(Image(dot), options).tokens.size(), 0u);
}

TEST(EdgeTokens, GreyImageGivesTheSame)
{
  const cv::Mat color = Image(Line{ 30, 2 });
  cv::Mat grey;
  cv::extractChannel(color, grey, 0);
  const EdgeChains a = FindEdges(color, EdgeTokenOptions()),
                   b = FindEdges(grey, EdgeTokenOptions());
  ASSERT_EQ(a.tokens.size(), b.tokens.size());
  for (std::size_t i = 0; i < a.tokens.size(); ++i)
  {
    EXPECT_LT((a.tokens[i].position - b.tokens[i].position).norm(), 1e-9);
    EXPECT_EQ(a.tokens[i].bright, b.tokens[i].bright);
  }
}

TEST(EdgeTokens, EmptyAndTinyImages)
{
  for (int size = 0; size < 6; ++size)
  {
    const cv::Mat image(size, size, CV_8UC3, cv::Scalar(10, 20, 30));
    EXPECT_EQ(FindEdges(image, EdgeTokenOptions()).NumberOfChains(), 0u) << size;
  }
}

TEST(EdgeTokens, OptionsOutOfRange)
{
  EdgeTokenOptions options;
  options.smoothing = 0;
  EXPECT_THROW(options.Check(), Error);
  options = EdgeTokenOptions();
  options.highContrast = options.lowContrast / 2;
  EXPECT_THROW(options.Check(), Error);
  options = EdgeTokenOptions();
  options.fitRadius = 0;
  EXPECT_THROW(options.Check(), Error);
}
