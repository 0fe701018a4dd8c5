// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/MaskedEdges.h"

#include "Images/ImageMask.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

// Light squares on a dark ground.
cv::Mat Squares()
{
  cv::Mat image(120, 160, CV_8UC3, cv::Scalar::all(40));
  for (int k = 0; k < 4; ++k)
  {
    cv::rectangle(image, { 20 + 32 * k, 30, 20, 60 }, cv::Scalar::all(200), cv::FILLED);
  }
  return image;
}

}

TEST(MaskedEdges, WithoutAMaskOrWithAWhiteOneAllStay)
{
  const EdgeChains edges = FindEdges(Squares(), EdgeTokenOptions());
  ASSERT_GT(edges.tokens.size(), 400u);
  EXPECT_EQ(EdgesOutside(edges, {}, 6).tokens.size(), edges.tokens.size());
  const cv::Mat white(120, 160, CV_8U, cv::Scalar(255));
  EXPECT_EQ(EdgesOutside(edges, white, 6).begin, edges.begin);
  const cv::Mat black(120, 160, CV_8U, cv::Scalar(0));
  EXPECT_TRUE(EdgesOutside(edges, black, 6).tokens.empty());
}

TEST(MaskedEdges, ExactlyTheTokensOutsideStayInOrder)
{
  const EdgeChains edges = FindEdges(Squares(), EdgeTokenOptions());
  cv::Mat mask(120, 160, CV_8U, cv::Scalar(255));
  mask(cv::Rect(0, 50, 160, 20)) = 0; // across all squares
  const EdgeChains outside = EdgesOutside(edges, mask, 1);
  std::size_t expected = 0;
  for (const EdgeToken& token : edges.tokens)
  {
    expected += token.position.y() < 50 || token.position.y() >= 70;
  }
  EXPECT_EQ(outside.tokens.size(), expected);
  EXPECT_GT(outside.NumberOfChains(), edges.NumberOfChains());
  for (std::size_t chain = 0; chain < outside.NumberOfChains(); ++chain)
  {
    ASSERT_LT(outside.begin[chain], outside.begin[chain + 1]);
    for (int i = outside.begin[chain]; i + 1 < outside.begin[chain + 1]; ++i)
    {
      EXPECT_LT(outside.Distance(i, i + 1), 3); // pixels
    }
  }
  for (const EdgeToken& token : outside.tokens)
  {
    EXPECT_TRUE(token.position.y() < 50 || token.position.y() >= 70);
  }
}

TEST(MaskedEdges, ShortRestsOfChainsAreNone)
{
  const EdgeChains edges = FindEdges(Squares(), EdgeTokenOptions());
  cv::Mat mask(120, 160, CV_8U, cv::Scalar(0));
  mask(cv::Rect(0, 58, 160, 4)) = 255; // four tokens of each upright side
  EXPECT_FALSE(EdgesOutside(edges, mask, 3).tokens.empty());
  EXPECT_TRUE(EdgesOutside(edges, mask, 7).tokens.empty());
}
