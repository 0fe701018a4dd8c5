// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/TrinocularMatcher.h"

#include "Common/Error.h"
#include "Support/SyntheticImages.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

constexpr double Pi = 3.14159265358979323846;

const std::vector<int> ThreeCameras = { 0, 1, 2 }; // reference, left, right
const std::vector<int> Column = { 0, 3, 4 };       // reference, up, down
const std::vector<int> FiveCameras = { 0, 1, 2, 3, 4 };

// Images of a scene and what was made of them.
struct MatcherTrial
{
  std::vector<ImageEdges> images;
  LargeVector<EdgeMatch> matches; // per token of the first image

  int Matched() const
  {
    return static_cast<int>(std::count_if(
      matches.begin(), matches.end(), [](const EdgeMatch& match) { return match.images > 0; }));
  }
};

using Change = std::function<void(int image, cv::Mat& pixels)>;

MatcherTrial Match(const Layers& layers, const std::vector<int>& cameras,
  const Change& change = nullptr, const MatcherOptions& options = MatcherOptions())
{
  const std::vector<Camera> all = CrossOfCameras();
  MatcherTrial trial;
  for (int camera : cameras)
  {
    cv::Mat pixels = Render(layers, all[camera]);
    if (change)
    {
      change(camera, pixels);
    }
    trial.images.push_back({ all[camera], FindEdges(pixels, EdgeTokenOptions()) });
  }
  trial.matches = MatchEdges(trial.images[0],
    std::vector<ImageEdges>(trial.images.begin() + 1, trial.images.end()), options);
  return trial;
}

// Disparity errors in pixels of one baseline (0.1), for the matches in the inside of the image.
std::vector<double> Errors(
  const MatcherTrial& trial, const std::function<double(double, double)>& depth)
{
  const Camera& camera = trial.images[0].camera;
  std::vector<double> errors;
  for (const EdgeMatch& match : trial.matches)
  {
    if (match.images > 0)
    {
      const Eigen::Vector3d point = camera.Unproject(match.imagePoint, 1 / match.disparity);
      errors.push_back(40 * (match.disparity - 1 / depth(point.x(), point.y())));
    }
  }
  return errors;
}

// Of plane z = depth: what a match must give wherever it is.
std::function<double(double, double)> AtDepth(double depth)
{
  return [depth](double, double) { return depth; };
}

double Mean(const std::vector<double>& values)
{
  double sum = 0;
  for (double value : values)
  {
    sum += value;
  }
  return sum / values.size();
}

double Share(const std::vector<double>& errors, double limit)
{
  return std::count_if(
           errors.begin(), errors.end(), [limit](double e) { return std::abs(e) < limit; }) /
    static_cast<double>(errors.size());
}

// A plane at depth 1 that is dark on one side of a line through its middle; the line makes the
// given angle with the x axis.
Layers StraightEdge(double degrees)
{
  const double c = std::cos(degrees * Pi / 180), s = std::sin(degrees * Pi / 180);
  Layer plane;
  plane.exists = Everywhere();
  plane.color = [c, s](double x, double y) {
    return (c * y - s * x > 0.0037) ? Eigen::Vector3d(180, 200, 190) : Eigen::Vector3d(60, 40, 50);
  };
  return { plane };
}

// Vertical stripes on a plate of the given half width at depth 1, before a distant plain wall.
Layers Stripes(double halfWidth)
{
  Layer plate;
  plate.exists = [halfWidth](double x, double y)
  { return std::abs(x) < halfWidth && std::abs(y) < 0.15; };
  plate.color = [](double x, double)
  {
    return std::fmod(x + 10, 0.04) < 0.02 ? Eigen::Vector3d(200, 200, 200)
                                          : Eigen::Vector3d(50, 50, 50);
  };
  Layer wall;
  wall.depth = 1.6;
  wall.exists = Everywhere();
  wall.color = Plain(120, 140, 100);
  return { plate, wall };
}

}

TEST(TrinocularMatcher, VerticalEdge)
{
  const MatcherTrial trial = Match(StraightEdge(90), ThreeCameras);
  const std::vector<double> errors = Errors(trial, AtDepth(1));
  EXPECT_GT(trial.Matched(), 160); // of 180 rows
  EXPECT_LT(std::abs(Mean(errors)), 0.03);
  EXPECT_EQ(Share(errors, 0.15), 1.0);
}

TEST(TrinocularMatcher, HorizontalEdgeIsLeftToTheOtherTriplet)
{
  EXPECT_EQ(Match(StraightEdge(0), ThreeCameras).Matched(), 0);
  const MatcherTrial trial = Match(StraightEdge(0), Column);
  EXPECT_GT(trial.Matched(), 215); // of 240 columns
  EXPECT_EQ(Share(Errors(trial, AtDepth(1)), 0.15), 1.0);
}

TEST(TrinocularMatcher, EdgeAtEvery15Degrees)
{
  for (int degrees = 0; degrees < 180; degrees += 15)
  {
    const MatcherTrial trial = Match(StraightEdge(degrees), FiveCameras);
    const std::vector<double> errors = Errors(trial, AtDepth(1));
    const double tokens = static_cast<double>(trial.images[0].edges.tokens.size());
    EXPECT_GT(trial.Matched() / tokens, 0.9) << degrees << " degrees";
    EXPECT_LT(std::abs(Mean(errors)), 0.03) << degrees << " degrees";
    EXPECT_EQ(Share(errors, 0.2), 1.0) << degrees << " degrees";
  }
}

TEST(TrinocularMatcher, SlantedPlane)
{
  Layer plane;
  plane.slope = { 0.6, -0.3 };
  plane.exists = Everywhere();
  plane.color = RandomSquares(0.05, 1);
  const MatcherTrial trial = Match({ plane }, FiveCameras);
  const auto depth = [&](double x, double y) { return 1 + plane.slope.dot(Eigen::Vector2d(x, y)); };
  const std::vector<double> errors = Errors(trial, depth);
  EXPECT_GT(trial.Matched() / static_cast<double>(trial.images[0].edges.tokens.size()), 0.7);
  EXPECT_LT(std::abs(Mean(errors)), 0.03);
  EXPECT_GT(Share(errors, 0.3), 0.98);
}

TEST(TrinocularMatcher, RepeatedPattern)
{
  for (const double halfWidth : { 0.1, 0.17 })
  {
    const MatcherTrial trial = Match(Stripes(halfWidth), ThreeCameras);
    const std::vector<double> errors = Errors(trial, AtDepth(1));
    EXPECT_GT(errors.size(), 0.75 * 120 * halfWidth / 0.01)
      << halfWidth; // 120 rows, 16 px a period
    EXPECT_GT(Share(errors, 0.3), 0.98) << halfWidth;
  }
}

TEST(TrinocularMatcher, SilhouetteBeforeTexturedBackground)
{
  Layer front;
  front.depth = 0.8;
  front.exists = [](double x, double y) { return std::abs(x) < 0.08 && std::abs(y) < 0.12; };
  front.color = Plain(40, 60, 230);
  Layer back;
  back.depth = 1.2;
  back.exists = Everywhere();
  back.color = RandomSquares(0.12, 2);
  const MatcherTrial trial = Match({ front, back }, ThreeCameras);
  int silhouette = 0, found = 0, wrong = 0;
  const Camera& camera = trial.images[0].camera;
  for (std::size_t i = 0; i < trial.matches.size(); ++i)
  {
    const Eigen::Vector3d p = camera.Unproject(trial.images[0].edges.tokens[i].position, 0.8);
    const bool outline = std::abs(std::abs(p.x()) - 0.08) < 0.002 && std::abs(p.y()) < 0.11;
    silhouette += outline;
    if (trial.matches[i].images > 0)
    {
      const double disparity = trial.matches[i].disparity;
      const bool isFront = std::abs(40 * (disparity - 1 / 0.8)) < 0.5;
      const bool isBack = std::abs(40 * (disparity - 1 / 1.2)) < 0.5;
      found += outline && isFront;
      wrong += !(isFront || isBack) || (outline && !isFront);
    }
  }
  EXPECT_GT(silhouette, 150); // of two sides of 110 rows
  EXPECT_GT(found, 0.7 * silhouette);
  EXPECT_LT(wrong, 0.02 * trial.Matched());
}

TEST(TrinocularMatcher, EdgeVisibleInTwoImagesOnly)
{
  // A plain screen hides the edge from the right camera only.
  Layers layers = StraightEdge(90);
  Layer screen;
  screen.depth = 0.5;
  screen.exists = [](double x, double) { return x > 0.03; };
  screen.color = Plain(60, 40, 50);
  layers.push_back(screen);
  const Camera camera = CrossOfCameras()[0];
  const auto near = [&](const MatcherTrial& trial)
  {
    int count = 0;
    for (const EdgeMatch& match : trial.matches)
    {
      const Eigen::Vector3d p = camera.Unproject(match.imagePoint, 1);
      count += match.images > 0 && std::abs(p.x() + 0.0037) < 0.003;
    }
    return count;
  };
  EXPECT_GT(near(Match(StraightEdge(90), ThreeCameras)), 160);
  EXPECT_EQ(near(Match(layers, ThreeCameras)), 0);
}

TEST(TrinocularMatcher, NoiseAlone)
{
  Layer plane;
  plane.exists = Everywhere();
  plane.color = Plain(120, 120, 120);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 40);
  const MatcherTrial trial = Match({ plane }, FiveCameras,
    [&](int, cv::Mat& pixels)
    {
      for (auto pixel = pixels.begin<cv::Vec3b>(); pixel != pixels.end<cv::Vec3b>(); ++pixel)
      {
        for (int c = 0; c < 3; ++c)
        {
          (*pixel)[c] = cv::saturate_cast<std::uint8_t>((*pixel)[c] + noise(random));
        }
      }
    });
  EXPECT_GT(trial.images[0].edges.tokens.size(), 1000u); // there is enough to be mistaken about
  EXPECT_LT(trial.Matched(), 0.01 * trial.images[0].edges.tokens.size());
}

TEST(TrinocularMatcher, ImagesOfDifferentBrightness)
{
  Layer plane;
  plane.exists = Everywhere();
  plane.color = RandomSquares(0.05, 4);
  const MatcherTrial same = Match({ plane }, FiveCameras);
  const MatcherTrial other = Match({ plane }, FiveCameras,
    [](int image, cv::Mat& pixels)
    {
      const double gain[5] = { 1.0, 0.6, 1.15, 0.8, 0.5 }, offset[5] = { 0, 5, -10, 15, 0 };
      pixels.convertTo(pixels, -1, gain[image], offset[image]);
    });
  EXPECT_GT(other.Matched(), 0.95 * same.Matched());
  EXPECT_GT(Share(Errors(other, AtDepth(1)), 0.3), 0.98);
}

TEST(TrinocularMatcher, DisparityRangeIsKept)
{
  MatcherOptions options;
  options.minimumDisparity = 1 / 0.9;
  EXPECT_EQ(Match(StraightEdge(90), ThreeCameras, nullptr, options).Matched(), 0);
  options.minimumDisparity = 1 / 1.1;
  options.maximumDisparity = 1 / 0.9;
  EXPECT_GT(Match(StraightEdge(90), ThreeCameras, nullptr, options).Matched(), 160);
}

TEST(TrinocularMatcher, NoEdges)
{
  Layer plane;
  plane.exists = Everywhere();
  plane.color = Plain(120, 120, 120);
  EXPECT_EQ(Match({ plane }, ThreeCameras).matches.size(), 0u);
}

TEST(TrinocularMatcher, BadInput)
{
  const std::vector<Camera> cameras = CrossOfCameras();
  const ImageEdges image{ cameras[0], EdgeChains() };
  EXPECT_THROW(MatchEdges(image, { { cameras[1], EdgeChains() } }, MatcherOptions()), Error);
  EXPECT_THROW(MatchEdges(image, { image, image }, MatcherOptions()), Error); // one place
  MatcherOptions options;
  options.tolerance = 0;
  EXPECT_THROW(options.Check(), Error);
  options = MatcherOptions();
  options.maximumDisparity = options.minimumDisparity;
  EXPECT_THROW(options.Check(), Error);
  options = MatcherOptions();
  options.minimumAngle = 90;
  EXPECT_THROW(options.Check(), Error);
}
