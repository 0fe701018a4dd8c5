// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayDisparityFilter.h"

#include "Data/ViewBlocks.h"
#include "Disparity/DelaunayDisparity.h"
#include "Disparity/FeatureThinning.h"
#include "Support/ErrorObserver.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <sstream>

using namespace freespace;

namespace
{

std::vector<View> MakeViews()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<View> views(4);
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    View& view = views[v];
    view.name = "cluster" + std::to_string(v);
    view.camera.K << 500, 0, 500, 0, 500, 500, 0, 0, 1;
    view.camera.width = view.camera.height = 1000;
    view.camera.R = Eigen::AngleAxisd(0.2 * v, Eigen::Vector3d::UnitY()).matrix();
    view.camera.t = { 0, 0, 3 };
    for (int i = 0; i < 300; ++i)
    {
      view.points.emplace_back(unit(random), unit(random), 0.1 * unit(random));
      view.imagePoints.push_back(view.camera.Project(view.points.back()));
    }
  }
  return views;
}

vtkSmartPointer<vtkMultiBlockDataSet> Blocks(const std::vector<View>& views)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    SetNamedBlock(blocks, static_cast<unsigned int>(i), views[i].name, BlockFromView(views[i]));
  }
  return blocks;
}

void ExpectSameMaps(const std::vector<DisparityMap>& a, const std::vector<DisparityMap>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].points, b[i].points);
    EXPECT_EQ(a[i].imagePoints, b[i].imagePoints);
    EXPECT_EQ(a[i].sourceView, b[i].sourceView);
    EXPECT_EQ(a[i].triangles, b[i].triangles);
  }
}

}

TEST(DelaunayDisparityFilter, SpatialFlipsReachTheCore)
{
  const std::vector<View> views = MakeViews();
  std::vector<std::vector<std::array<int, 3>>> triangles;
  for (const bool isOn : { false, true })
  {
    DelaunayDisparityOptions options;
    options.spatialFlips = isOn;
    vtkNew<vtkDelaunayDisparityFilter> filter;
    filter->SetInputDataObject(Blocks(views));
    filter->SetSupport(0);
    filter->SetFeatureSpacing(0);
    filter->ContinueBackgroundOff();
    filter->SetSpatialFlips(isOn);
    filter->Update();
    const std::vector<DisparityMap> maps = MapsFromBlocks(filter->GetOutput());
    ExpectSameMaps(maps, TriangulateViews(views, options));
    triangles.push_back(maps.front().triangles);
  }
  EXPECT_NE(triangles[0], triangles[1]) << "nothing is flipped";
}

TEST(DelaunayDisparityFilter, GivesTheMapsOfTheCoreForAnyNumberOfThreads)
{
  const std::vector<View> views = MakeViews();
  DelaunayDisparityOptions options;
  options.tolerance = 0.002;
  const std::vector<DisparityMap> expected = TriangulateViews(views, options);
  EXPECT_NE(expected[0].points.size(), views[0].points.size()) << "nothing was inserted";
  for (const int threads : { 3, 2, 1 }) // the pool can only be made smaller
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkDelaunayDisparityFilter> filter;
    filter->SetInputDataObject(Blocks(views));
    filter->SetTolerance(0.002);
    filter->SetFeatureSpacing(0);
    filter->ContinueBackgroundOff();
    filter->SetSupport(0);
    filter->Update();
    ExpectSameMaps(MapsFromBlocks(filter->GetOutput()), expected);
  }
}

TEST(DelaunayDisparityFilter, SettingsReachTheCore)
{
  const std::vector<View> views = MakeViews();
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(Blocks(views));
  filter->MinimumDisparityOff();
  filter->SetFeatureSpacing(0);
  filter->ContinueBackgroundOff();
  filter->SetSupport(0);
  filter->Update();
  const std::vector<DisparityMap> maps = MapsFromBlocks(filter->GetOutput());
  ASSERT_EQ(maps.size(), views.size());
  EXPECT_EQ(maps[2].points, views[2].points);
  EXPECT_EQ(maps[2].sourceView, std::vector<int>(views[2].points.size(), 2));

  constexpr double spacing = 40;
  filter->SetFeatureSpacing(spacing);
  filter->Update();
  FeatureThinningOptions thinning;
  thinning.spacing = spacing;
  const View thin = ThinFeatures(views[2], thinning);
  EXPECT_LT(thin.points.size(), views[2].points.size());
  EXPECT_EQ(MapFromBlocks(filter->GetOutput(), 2).points, thin.points);

  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("MinimumDisparity: 0"), std::string::npos);
  EXPECT_NE(text.str().find("Tolerance: 0.0002"), std::string::npos);
}

TEST(DelaunayDisparityFilter, DeviationsAreThoseOfAViewsOwnFeatures)
{
  std::vector<View> views = MakeViews();
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    views[v].deviations.assign(views[v].points.size(), 0.001 * static_cast<double>(v + 1));
  }
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(Blocks(views));
  filter->Update();
  const std::vector<DisparityMap> maps = MapsFromBlocks(filter->GetOutput());
  for (std::size_t v = 0; v < maps.size(); ++v)
  {
    ASSERT_EQ(maps[v].deviations.size(), maps[v].points.size());
    for (std::size_t i = 0; i < maps[v].points.size(); ++i)
    {
      const bool isOwn = maps[v].sourceView[i] == static_cast<int>(v);
      EXPECT_NEAR(maps[v].deviations[i], isOwn ? 0.001 * static_cast<double>(v + 1) : 0, 1e-12);
    }
  }
}

TEST(DelaunayDisparityFilter, OutliersAndLongTrianglesAreLeftOut)
{
  std::vector<View> views = MakeViews();
  for (View& view : views) // a smooth surface, so that neighbours agree
  {
    for (std::size_t i = 0; i < view.points.size(); ++i)
    {
      view.points[i].z() *= 0.01;
      view.imagePoints[i] = view.camera.Project(view.points[i]);
    }
  }
  const Eigen::Vector3d outlier = views[1].camera.Unproject({ 500, 500 }, 1.5);
  views[1].points.push_back(outlier);
  views[1].imagePoints.emplace_back(500, 500);
  const auto holdsOutlier = [&outlier](const DisparityMap& map)
  { return std::find(map.points.begin(), map.points.end(), outlier) != map.points.end(); };

  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(Blocks(views));
  filter->SetSupport(0);
  filter->Update();
  std::vector<DisparityMap> maps = MapsFromBlocks(filter->GetOutput());
  EXPECT_TRUE(holdsOutlier(maps[0]));
  // Of the triangles those of which no edge is longer than 40 pixels.
  const auto small = std::count_if(maps[3].triangles.begin(), maps[3].triangles.end(),
    [&map = maps[3]](const std::array<int, 3>& t)
    {
      const auto edge = [&](int a, int b)
      { return (map.imagePoints[t[a]] - map.imagePoints[t[b]]).norm(); };
      return std::max({ edge(0, 1), edge(1, 2), edge(2, 0) }) <= 40;
    });
  const auto all = static_cast<std::ptrdiff_t>(maps[3].triangles.size());

  filter->SetSupport(2);
  filter->Update();
  for (const DisparityMap& map : MapsFromBlocks(filter->GetOutput()))
  {
    EXPECT_FALSE(holdsOutlier(map));
  }
  filter->SetSupport(0);
  filter->SetLongestEdge(40);
  filter->Update();
  maps = MapsFromBlocks(filter->GetOutput());
  EXPECT_EQ(static_cast<std::ptrdiff_t>(maps[3].triangles.size()), small);
  EXPECT_LT(small, all);
  EXPECT_GT(small, 0);
}

TEST(DelaunayDisparityFilter, SettingOutOfRangeIsAnError)
{
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(Blocks(MakeViews()));
  filter->SetGreatestDepthRatio(0.5);
  const std::string error = ErrorOfUpdate(filter);
  EXPECT_NE(error.find("0 or above 1"), std::string::npos) << error;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(DelaunayDisparityFilter, ErrorNamesTheViewAndLeavesNothing)
{
  std::vector<View> views = MakeViews();
  views[2].points.resize(2);
  views[2].imagePoints.resize(2);
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(Blocks(views));
  const std::string error = ErrorOfUpdate(filter);
  EXPECT_NE(error.find("'cluster2' has 2 usable features"), std::string::npos) << error;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(DelaunayDisparityFilter, EmptyInputGivesNoMaps)
{
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(vtkSmartPointer<vtkMultiBlockDataSet>::New());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}
