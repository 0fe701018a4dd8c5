// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"
#include "Freespace/ViewAgreement.h"

#include "Support/PlainSettings.h"
#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

constexpr int Side = 21;

// A wall at a depth of 10, seen by a camera at the given place along x; `shift` moves what it believes of it.
DisparityMap Wall(double eyeX, double shift, int index)
{
  DisparityMap map;
  map.name = "wall" + std::to_string(index);
  map.camera.K << 1000, 0, 200, 0, 1000, 200, 0, 0, 1;
  map.camera.width = map.camera.height = 400;
  map.camera.t = Vector3d(-eyeX, 0, 0);
  for (int i = 0; i < Side * Side; ++i)
  {
    const Vector3d point(0.1 * (i % Side) - 1, 0.1 * (i / Side) - 1, 10 + shift);
    map.points.push_back(point);
    map.imagePoints.push_back(map.camera.Project(point));
    map.sourceView.push_back(index);
    if (i % Side > 0 && i >= Side)
    {
      map.triangles.push_back({ i - Side - 1, i - Side, i });
      map.triangles.push_back({ i - Side - 1, i, i - 1 });
    }
  }
  return map;
}

int Chosen(const std::vector<double>& shifts)
{
  std::vector<DisparityMap> maps;
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    maps.push_back(Wall(0.1 * static_cast<double>(i), shifts[i], static_cast<int>(i)));
  }
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = FreespaceUnionOptions::AutomaticViews;
  return FreespaceUnion(maps, options).MinimumViews();
}

std::vector<AgreementErrors> Errors(const std::vector<DisparityMap>& maps, int most)
{
  std::vector<std::unique_ptr<ViewFreespace>> views;
  std::vector<ViewFeatures> features;
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    views.push_back(std::make_unique<ViewFreespace>(maps[i]));
    features.push_back(FeaturesOfMap(maps[i], i));
  }
  const Eigen::AlignedBox3d box(Vector3d(-9, -9, 0), Vector3d(9, 9, 20));
  return ErrorsOfAgreement(views, features, box, 1, most);
}

}

TEST(ViewAgreement, CountsWhatIsErodedAndWhatIsBlocked)
{
  // The features are 0.1 apart, which is the step. One view believes the wall to be 0.5 farther.
  const std::vector<AgreementErrors> errors =
    Errors({ Wall(0, 0, 0), Wall(0.05, 0, 1), Wall(0.1, 0, 2), Wall(0.15, 0.5, 3) }, 4);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_NEAR(errors[0].eroded, 0.7, 0.1) << "behind the features of the three right views";
  EXPECT_NEAR(errors[0].blocked, 0.0, 1e-12) << "each view sees what is before its own features";
  EXPECT_NEAR(errors[1].eroded, 0.0, 0.02);
  EXPECT_NEAR(errors[1].blocked, 0.25, 0.1) << "before the wrong view's";
  EXPECT_GT(errors[3].blocked, 0.2);
}

TEST(ViewAgreement, AsksForOneViewWhereAllAreRight)
{
  EXPECT_EQ(Chosen({ 0, 0, 0, 0 }), 1);
  EXPECT_EQ(Chosen({ 0 }), 1) << "there is no other";
}

TEST(ViewAgreement, AsksForTwoWhereOneOfManyCarvesWhatTheOthersSaw)
{
  EXPECT_EQ(Chosen({ 0, 0, 1, 0, 0 }), 2);
}

TEST(ViewAgreement, OfNothingIsOne)
{
  EXPECT_EQ(ViewsThatMustAgree({}), 1);
  EXPECT_EQ(ViewsThatMustAgree({ { 0.1, 0 }, { 0.05, 0.04 } }), 2);
  EXPECT_EQ(ViewsThatMustAgree({ { 0.1, 0 }, { 0.05, 0.06 } }), 1);
  EXPECT_EQ(ViewsThatMustAgree({ { 0.001, 0 }, { 0.0008, 0.0005 } }), 2)
    << "it costs hardly any free space";
  EXPECT_EQ(ViewsThatMustAgree({ { 0.001, 0 }, { 0.0008, 0.002 } }), 1);
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = FreespaceUnionOptions::AutomaticViews;
  EXPECT_EQ(FreespaceUnion(std::vector<DisparityMap>(), options).MinimumViews(), 1);
}
