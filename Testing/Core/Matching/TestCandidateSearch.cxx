// SPDX-License-Identifier: BSD-3-Clause
// The search for candidates: by hand, and against a comparison with all pieces of all chains.
#include "Matching/CandidateSearch.h"

#include "Support/SyntheticImages.h"
#include "Support/Core/EdgeSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace freespace;

namespace
{

void AddToken(EdgeChains& edges, const Eigen::Vector2d& position, const Eigen::Vector2d& tangent,
  std::uint8_t bright = 150, std::uint8_t dark = 150)
{
  EdgeToken& token = edges.tokens.emplace_back();
  token.position = position;
  token.tangent = tangent;
  token.contrast = 100;
  token.bright = SideOf(bright);
  token.dark = SideOf(dark);
}

// A vertical chain of 40 tokens downwards from a row, a token per pixel.
void AddUprightLine(
  EdgeChains& edges, double column, double row, std::uint8_t bright = 150, std::uint8_t dark = 150)
{
  for (int i = 0; i < 40; ++i)
  {
    AddToken(edges, { column, row + i }, { 0, 1 }, bright, dark);
  }
  edges.begin.push_back(static_cast<int>(edges.tokens.size()));
}

// Cameras 0.1 to the left and 0.2 to the right of the reference, that see vertical lines in space at these
// disparities, which the reference sees at column 320. Rows of its tokens are in the middle of the others' pieces.
struct Lines
{
  explicit Lines(const std::vector<double>& disparities)
    : reference{ ParallelCamera(0), {} }
    , others{ { ParallelCamera(-0.1), {} }, { ParallelCamera(0.2), {} } }
  {
    AddUprightLine(this->reference.edges, 320, 100.5);
    for (const double disparity : disparities)
    {
      AddUprightLine(this->others[0].edges, 320 + 50 * disparity, 100);
      AddUprightLine(this->others[1].edges, 320 - 100 * disparity, 100);
    }
  }

  MatcherOptions options;
  ImageEdges reference;
  std::vector<ImageEdges> others;
};

std::vector<EdgeCandidate> FindAll(CandidateSearch& search, int token)
{
  search.Candidates.clear();
  search.FindLines(token);
  search.FindCandidates(token, std::vector<char>(search.NumberOfImages(), 0));
  return search.Candidates;
}

// A chain that wanders over the image of SyntheticImages' cameras.
void AddRandomChain(EdgeChains& edges, std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  Eigen::Vector2d position(20 + 200 * unit(random), 20 + 140 * unit(random));
  double angle = 2 * M_PI * unit(random);
  for (int i = 0; i < 12; ++i)
  {
    angle += 0.3 * (unit(random) - 0.5);
    AddToken(edges, position, { std::cos(angle), std::sin(angle) });
    position += edges.tokens.back().tangent;
  }
  edges.begin.push_back(static_cast<int>(edges.tokens.size()));
}

// A piece of another image that the epipolar line crosses.
struct Crossing
{
  double disparity, sigma, cosine;
  bool isSure; // not so close to a bound that rounding decides
};

using Crossings = std::map<std::pair<int, int>, Crossing>; // by image and token

// All pieces of all chains that cross the epipolar line of a token as the options want, by the geometry of
// each pair.
Crossings CrossingsOf(const EdgeToken& token, const Camera& camera,
  const std::vector<ImageEdges>& others, const MatcherOptions& options)
{
  constexpr double radian = M_PI / 180, slack = 1e-4;
  Crossings crossings;
  for (int image = 0; image < static_cast<int>(others.size()); ++image)
  {
    const EdgeChains& edges = others[image].edges;
    const EpipolarPair pair(camera, others[image].camera);
    const EpipolarPair::Ray line = pair.FromReference(token.position);
    const Eigen::Vector2d along = (pair.ReferenceJacobian(line) * token.tangent).normalized();
    for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
    {
      for (int k = edges.begin[chain]; k + 1 < edges.begin[chain + 1]; ++k)
      {
        const EpipolarPair::Ray a = pair.FromOther(edges.tokens[k].position);
        const EpipolarPair::Ray b = pair.FromOther(edges.tokens[k + 1].position);
        const double at = (line.v - a.v) / (b.v - a.v);
        const Eigen::Vector2d tangent =
          (pair.OtherJacobian(a) * edges.tokens[k].tangent).normalized();
        Crossing crossing;
        crossing.disparity = pair.Disparity(line, a.u + at * (b.u - a.u));
        crossing.sigma =
          line.scale / pair.Baseline * edges.tokens[k].Uncertainty() / std::abs(tangent.y());
        crossing.cosine = std::abs(along.dot(tangent));
        // Each as how far it is within its bound.
        const double within =
          std::min({ at, 1 - at, (crossing.disparity - options.minimumDisparity) * pair.Baseline,
            (options.maximumDisparity - crossing.disparity) * pair.Baseline,
            crossing.cosine - std::cos(options.angleTolerance * radian),
            std::abs(tangent.y()) - std::sin(options.minimumAngle * radian),
            std::abs(along.y()) - std::sin(options.minimumAngle * radian) });
        if (within > -slack)
        {
          crossing.isSure = within > slack;
          crossings[{ image, k }] = crossing;
        }
      }
    }
  }
  return crossings;
}

// By how much a crossing misses the nearest one of another image that can confirm it, in pixels of the
// longest baseline; negative: it does not.
double Missing(
  const Crossings::value_type& crossing, const Crossings& all, double baseline, double tolerance)
{
  double missing = HUGE_VAL;
  for (const auto& [key, other] : all)
  {
    if (key.first != crossing.first.first && other.isSure)
    {
      const double most = 2 * tolerance * std::max(crossing.second.sigma, other.sigma);
      missing = std::min(
        missing, (std::abs(other.disparity - crossing.second.disparity) - most) * baseline);
    }
  }
  return missing;
}

}

TEST(CandidateSearch, WithoutEdgesThereIsNothingToFind)
{
  const Lines lines({});
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  EXPECT_EQ(search.FindLines(7), 2);
  EXPECT_TRUE(FindAll(search, 7).empty());
  search.FollowLeads(7);
  EXPECT_TRUE(search.Candidates.empty());
  EXPECT_EQ(search.NumberOfTokens(0), 0u);
}

TEST(CandidateSearch, ALineIsFoundAtItsDisparity)
{
  const Lines lines({ 0.4 });
  CandidateSearch search(lines.reference, lines.others, lines.options);
  EXPECT_EQ(search.NumberOfImages(), 2u);
  EXPECT_EQ(search.NumberOfTokens(1), 40u);
  EXPECT_NEAR(search.LongestBaseline(), 100, 1e-9);
  search.FindRays(0, 40);
  for (int token = 0; token < 39; ++token)
  {
    const auto found = FindAll(search, token);
    ASSERT_EQ(found.size(), 2u) << token;
    for (int image = 0; image < 2; ++image)
    {
      EXPECT_EQ(found[image].image, image);
      EXPECT_EQ(found[image].token, token);
      EXPECT_NEAR(found[image].disparity, 0.4, 1e-6);
      // One pixel of 50 and of 100 per unit of disparity.
      EXPECT_NEAR(found[image].sigma, image == 0 ? 0.02 : 0.01, 1e-4);
      EXPECT_NEAR(std::abs(found[image].shift), image == 0 ? 0.02 : 0.01, 1e-4);
      EXPECT_NEAR(found[image].cost, 0, 1e-3);
    }
  }
  EXPECT_TRUE(FindAll(search, 39).empty()) << "below the last piece";
}

TEST(CandidateSearch, WhatNoImageCanConfirmIsLeftOut)
{
  Lines lines({ 0.4 });
  AddUprightLine(lines.others[0].edges, 320 + 50 * 1.5, 100);
  AddUprightLine(lines.others[1].edges, 320 - 100 * 0.9, 100);
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  const auto found = FindAll(search, 20);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].disparity, 0.4, 1e-6);
  EXPECT_NEAR(found[1].disparity, 0.4, 1e-6);
}

TEST(CandidateSearch, ImagesToSkipAreNotSearched)
{
  const Lines lines({ 0.4 });
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  search.FindLines(20);
  search.FindCandidates(20, { 1, 0 });
  EXPECT_TRUE(search.Candidates.empty()) << "one image confirms nothing";
  // A known candidate of the skipped image can.
  const EdgeCandidate known = FindAll(search, 19)[0];
  search.Candidates = { known };
  search.FindLines(20);
  search.FindCandidates(20, { 1, 0 });
  ASSERT_EQ(search.Candidates.size(), 2u);
  EXPECT_EQ(search.Candidates[1].image, 1);
}

TEST(CandidateSearch, EdgesAlongTheEpipolarLineAreLeftToOtherImages)
{
  Lines lines({ 0.4 });
  lines.reference.edges = {};
  for (int i = 0; i < 40; ++i)
  {
    AddToken(lines.reference.edges, { 300.5 + i, 120.5 }, { 1, 0 });
  }
  lines.reference.edges.begin.push_back(40);
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  EXPECT_EQ(search.FindLines(20), 0);
  EXPECT_FALSE(search.IsUsable(0));
  EXPECT_FALSE(search.IsUsable(1));
  EXPECT_TRUE(FindAll(search, 20).empty());
}

// The images show the same lines, so that their colours need no compensation.
TEST(CandidateSearch, OneSideMustLookAlike)
{
  Lines lines({});
  lines.reference.edges = {};
  AddUprightLine(lines.reference.edges, 320, 100.5, 200, 20);
  AddUprightLine(lines.reference.edges, 400, 100.5, 60, 5);    // darker on both sides
  AddUprightLine(lines.reference.edges, 480, 100.5, 200, 150); // the same on its brighter side
  for (int line = 0; line < 3; ++line)
  {
    const std::uint8_t bright[] = { 200, 60, 200 }, dark[] = { 20, 5, 150 };
    AddUprightLine(lines.others[0].edges, 320 + 50 * (0.4 + line), 100, bright[line], dark[line]);
    AddUprightLine(lines.others[1].edges, 320 - 100 * (0.4 + line), 100, bright[line], dark[line]);
  }
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  std::map<int, std::vector<float>> costs; // by the line
  for (const EdgeCandidate& candidate : FindAll(search, 20))
  {
    costs[candidate.token / 40].push_back(candidate.cost);
    EXPECT_NEAR(candidate.disparity, 0.4 + candidate.token / 40, 1e-6);
  }
  ASSERT_EQ(costs[0].size(), 2u);
  EXPECT_NEAR(costs[0][0], 0, 0.01);
  EXPECT_TRUE(costs[1].empty());
  ASSERT_EQ(costs[2].size(), 2u);
  EXPECT_NEAR(costs[2][0], 0.2, 0.01) << "all of the worse side's weight";
}

TEST(CandidateSearch, LeadsAreFollowedAlongTheirChains)
{
  const Lines lines({ 0.4, 0.8 });
  CandidateSearch search(lines.reference, lines.others, lines.options);
  search.FindRays(0, 40);
  const auto first = FindAll(search, 10);
  ASSERT_EQ(first.size(), 4u);
  for (const EdgeCandidate& candidate : first)
  {
    search.AddLead(candidate);
    search.AddLead(candidate); // adds nothing
  }
  for (const int token : { 3, 10, 17 })
  {
    search.Candidates.clear();
    search.FindLines(token);
    search.FollowLeads(token);
    ASSERT_EQ(search.Candidates.size(), 4u) << token;
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(search.Candidates[i].image, first[i].image) << token;
      EXPECT_NEAR(search.Candidates[i].disparity, first[i].disparity, 1e-6) << token;
      EXPECT_EQ(search.Candidates[i].token - first[i].token, token - 10) << token;
    }
  }
  search.Candidates.clear();
  search.FindLines(25);
  search.FollowLeads(25);
  EXPECT_TRUE(search.Candidates.empty()) << "a lead reaches over a few pieces only";
  search.ClearLeads();
  search.FindLines(11);
  search.FollowLeads(11);
  EXPECT_TRUE(search.Candidates.empty());
}

TEST(CandidateSearch, FindsWhatAComparisonWithAllPiecesFinds)
{
  std::mt19937 random(23);
  MatcherOptions options;
  options.minimumDisparity = 0.6;
  options.maximumDisparity = 2.5;
  const std::vector<Camera> cameras = CrossOfCameras();
  std::size_t confirmable = 0, filtered = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    ImageEdges reference{ cameras[0], {} };
    std::vector<ImageEdges> others;
    for (int chain = 0; chain < 6; ++chain)
    {
      AddRandomChain(reference.edges, random);
    }
    for (int image = 1; image < 5; ++image)
    {
      others.push_back({ cameras[image], {} });
      for (int chain = 0; chain < 150; ++chain)
      {
        AddRandomChain(others.back().edges, random);
      }
    }
    CandidateSearch search(reference, others, options);
    for (std::size_t chain = 0; chain < reference.edges.NumberOfChains(); ++chain)
    {
      const int begin = reference.edges.begin[chain], end = reference.edges.begin[chain + 1];
      search.FindRays(begin, end);
      for (int token = begin; token < end; ++token)
      {
        const Crossings expected =
          CrossingsOf(reference.edges.tokens[token], cameras[0], others, options);
        std::map<std::pair<int, int>, EdgeCandidate> found;
        for (const EdgeCandidate& candidate : FindAll(search, token))
        {
          EXPECT_TRUE(found.emplace(std::pair(candidate.image, candidate.token), candidate).second);
        }
        for (const auto& crossing : expected)
        {
          const double missing =
            Missing(crossing, expected, search.LongestBaseline(), options.tolerance);
          if (crossing.second.isSure && missing < 0)
          {
            ++confirmable;
            ASSERT_TRUE(found.count(crossing.first)) << trial << ": token " << token;
          }
          // What is more than some pixels off everything is not even compared: bins are a pixel wide.
          if (missing > 3)
          {
            ++filtered;
            EXPECT_FALSE(found.count(crossing.first)) << trial << ": token " << token;
          }
        }
        for (const auto& [key, candidate] : found)
        {
          const auto crossing = expected.find(key);
          ASSERT_NE(crossing, expected.end()) << trial << ": token " << token;
          EXPECT_NEAR(candidate.disparity, crossing->second.disparity, 2e-4);
          EXPECT_NEAR(candidate.sigma / crossing->second.sigma, 1, 1e-3);
          EXPECT_NEAR(candidate.cost,
            0.2 * (1 - crossing->second.cosine) /
              (1 - std::cos(options.angleTolerance * M_PI / 180)),
            2e-3)
            << "all look alike";
        }
      }
    }
  }
  EXPECT_GT(confirmable, 200u);
  EXPECT_GT(filtered, 200u);
}
