// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/SparseViews.h"

#include "Common/Error.h"
#include "Support/SyntheticModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace freespace;

namespace
{

SparseViewOptions NoLimits()
{
  SparseViewOptions options;
  options.minimumTrackLength = 1;
  options.maximumError = std::numeric_limits<double>::infinity();
  options.minimumAngle = 0;
  options.minimumFeatures = 0;
  return options;
}

std::size_t CountFeatures(const std::vector<SparseView>& views)
{
  std::size_t count = 0;
  for (const SparseView& view : views)
  {
    count += view.points.size();
  }
  return count;
}

std::size_t CountObservations(const SparseModel& model)
{
  std::size_t count = 0;
  for (const SparsePoint& point : model.points)
  {
    count += point.track.size();
  }
  return count;
}

void ExpectConsistent(const SparseModel& model, const std::vector<SparseView>& views)
{
  for (const SparseView& view : views)
  {
    const SparseImage& image = model.images[view.image];
    EXPECT_EQ(view.imageFile, image.name);
    ASSERT_EQ(view.points.size(), view.imagePoints.size());
    ASSERT_EQ(view.points.size(), view.point.size());
    ASSERT_EQ(view.points.size(), view.observation.size());
    for (std::size_t i = 0; i < view.points.size(); ++i)
    {
      EXPECT_EQ(view.points[i], model.points[view.point[i]].position);
      EXPECT_EQ(image.observations[view.observation[i]].point, model.points[view.point[i]].id);
    }
  }
}

// Adds an observation of a point by an image.
void Observe(SparseModel& model, std::size_t image, std::size_t point, const Eigen::Vector2d& pixel)
{
  model.points[point].track.push_back({ model.images[image].id,
    static_cast<std::uint32_t>(model.images[image].observations.size()) });
  model.images[image].observations.push_back({ pixel, model.points[point].id });
}

}

TEST(SparseViews, EveryObservationWithoutLimits)
{
  const SparseModel model = MakeSyntheticModel(5, 80);
  const std::vector<SparseView> views = ViewsFromModel(model, NoLimits());
  ASSERT_EQ(views.size(), 5u);
  EXPECT_EQ(CountFeatures(views), CountObservations(model));
  ExpectConsistent(model, views);
}

TEST(SparseViews, DistortionIsTakenOut)
{
  const SparseModel model = MakeSyntheticModel(5, 80, LensModel::Radial);
  SparseViewOptions options = NoLimits();
  options.maximumError = 1e-5;
  const std::vector<SparseView> views = ViewsFromModel(model, options);
  EXPECT_EQ(CountFeatures(views), CountObservations(model)) << "they are exact";
  double largest = 0;
  for (const SparseView& view : views)
  {
    for (std::size_t i = 0; i < view.points.size(); ++i)
    {
      const Eigen::Vector2d shown =
        model.images[view.image].observations[view.observation[i]].pixel;
      largest = std::max(largest, (view.imagePoints[i] - shown).norm());
    }
  }
  EXPECT_GT(largest, 2) << "there was nothing to take out";
}

TEST(SparseViews, TrackLength)
{
  SparseModel model = MakeSyntheticModel(5, 80);
  SparseViewOptions options = NoLimits();
  for (int length = 1; length <= 6; ++length)
  {
    options.minimumTrackLength = length;
    std::size_t expected = 0;
    for (const SparsePoint& point : model.points)
    {
      expected += static_cast<int>(point.track.size()) >= length ? point.track.size() : 0;
    }
    EXPECT_EQ(CountFeatures(ViewsFromModel(model, options)), expected);
  }
}

// One image that sees a point three times is no track of three images.
TEST(SparseViews, TrackWithinOneImage)
{
  SparseModel model = MakeSyntheticModel(2, 1);
  for (SparseImage& image : model.images)
  {
    image.observations.clear();
  }
  Observe(model, 0, 0, { 1, 2 });
  Observe(model, 0, 0, { 3, 4 });
  Observe(model, 0, 0, { 5, 6 });
  Observe(model, 1, 0, { 5, 6 });
  SparseViewOptions options = NoLimits();
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, options)), 4u);
  options.minimumTrackLength = 2;
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, options)), 4u);
  options.minimumTrackLength = 3;
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, options)), 0u);
}

TEST(SparseViews, ReprojectionError)
{
  SparseModel model = MakeSyntheticModel(5, 80);
  SparseViewOptions options = NoLimits();
  options.maximumError = 1;
  const std::size_t before = CountFeatures(ViewsFromModel(model, options));
  std::vector<SparseObservation>& observations = model.images[2].observations;
  const auto matched = std::find_if(observations.begin(), observations.end(),
    [](const SparseObservation& observation)
    { return observation.point != SparseObservation::noPoint; });
  ASSERT_NE(matched, observations.end());
  matched->pixel += Eigen::Vector2d(0.8, 0.8);
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, options)), before - 1);
}

TEST(SparseViews, TriangulationAngle)
{
  // Cameras at -0.1, 0 and 0.1 look along z at points at different depths.
  SparseModel model;
  model.cameras.push_back({ 1, LensModel::Pinhole, 800, 800, { 800, 800, 400, 400 } });
  for (int i = 0; i < 3; ++i)
  {
    SparseImage& image = model.images.emplace_back();
    image.id = i;
    image.name = std::to_string(i);
    image.camera = 1;
    image.translation = { 0.1 - 0.1 * i, 0, 0 };
  }
  const double degrees[] = { 1.9, 2.1, 30, 40 };
  for (std::size_t k = 0; k < 4; ++k)
  {
    SparsePoint& point = model.points.emplace_back();
    point.id = k;
    point.position = { 0, 0, 0.1 / std::tan(degrees[k] / 2 * M_PI / 180) };
    for (std::size_t i = 0; i < 3; ++i)
    {
      Observe(model, i, k, ShowPoint(model, i, point.position));
    }
  }
  SparseViewOptions options = NoLimits();
  options.minimumAngle = 2;
  EXPECT_EQ(ViewsFromModel(model, options).at(0).point, (std::vector<int>{ 1, 2, 3 }));
  options.minimumAngle = 80; // the better half
  EXPECT_EQ(ViewsFromModel(model, options).at(0).point, (std::vector<int>{ 2, 3 }));
}

// A known defect of another program: it divided by the depth of such a point.
TEST(SparseViews, PointThatCoincidesWithACameraCentre)
{
  SparseModel model = MakeSyntheticModel(4, 20);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  model.points[0].position = images[1].camera.Center();
  for (const SparseViewOptions& options : { NoLimits(), SparseViewOptions() })
  {
    const std::vector<SparseView> views = ViewsFromModel(model, options);
    ASSERT_FALSE(views.empty());
    for (const SparseView& view : views)
    {
      for (std::size_t i = 0; i < view.points.size(); ++i)
      {
        const double disparity = 1 / view.camera.Depth(view.points[i]);
        EXPECT_TRUE(std::isfinite(disparity) && disparity > 0);
        EXPECT_FALSE(view.image == 1 && view.point[i] == 0);
      }
    }
  }
}

TEST(SparseViews, PointsBehindCamerasAndPixelsThatAreNotNumbers)
{
  SparseModel model = MakeSyntheticModel(4, 20);
  const std::size_t before = CountFeatures(ViewsFromModel(model, NoLimits()));
  const std::size_t track = model.points[0].track.size();
  model.points[0].position = { 0, 0, -100 };
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, NoLimits())), before - track);
  model.images[3].observations.back().pixel.x() = std::numeric_limits<double>::quiet_NaN();
  ASSERT_NE(model.images[3].observations.back().point, SparseObservation::noPoint);
  EXPECT_EQ(CountFeatures(ViewsFromModel(model, NoLimits())), before - track - 1);
}

TEST(SparseViews, ImagesWithFewFeaturesAreLeftOut)
{
  SparseModel model = MakeSyntheticModel(4, 40);
  model.images[1].observations.clear();
  const std::vector<SparseView> views = ViewsFromModel(model, SparseViewOptions());
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[1].image, 2);
  EXPECT_EQ(ViewsFromModel(model, NoLimits()).size(), 4u);
}

TEST(SparseViews, EmptyModel)
{
  EXPECT_TRUE(ViewsFromModel(SparseModel(), SparseViewOptions()).empty());
  SparseModel withoutPoints = MakeSyntheticModel(4, 40);
  withoutPoints.points.clear();
  EXPECT_EQ(CountFeatures(ViewsFromModel(withoutPoints, NoLimits())), 0u);
}

TEST(SparseViews, OptionsOutOfRange)
{
  SparseViewOptions options;
  options.minimumTrackLength = 0;
  EXPECT_THROW(ViewsFromModel(SparseModel(), options), Error);
  options = {};
  options.maximumError = 0;
  EXPECT_THROW(ViewsFromModel(SparseModel(), options), Error);
  options = {};
  options.minimumAngle = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ViewsFromModel(SparseModel(), options), Error);
}
