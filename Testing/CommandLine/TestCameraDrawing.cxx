// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/CameraDrawing.h"

#include "Common/ParseNumber.h"
#include "Support/Core/CountParts.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <regex>

using namespace freespace;

namespace
{

Camera At(double x, double y, double z)
{
  Camera camera;
  camera.K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  camera.width = 640;
  camera.height = 480;
  camera.R << 1, 0, 0, 0, 0, -1, 0, 1, 0; // looks along +y, up is +z
  camera.t = -camera.R * Eigen::Vector3d(x, y, z);
  return camera;
}

double NumberOf(const std::string& text)
{
  return ParseNumber<double>(text).value();
}

// Every coordinate of the drawing's paths.
std::vector<Eigen::Vector2d> Coordinates(const std::string& svg)
{
  std::vector<Eigen::Vector2d> points;
  const std::regex pair("[ML](-?[0-9.]+) (-?[0-9.]+)");
  for (std::sregex_iterator at(svg.begin(), svg.end(), pair), end; at != end; ++at)
  {
    points.emplace_back(NumberOf((*at)[1]), NumberOf((*at)[2]));
  }
  return points;
}

}

TEST(CameraDrawing, HasEveryCameraAndOneReferenceForEachGroup)
{
  const std::vector<CameraGroup> groups = { { "a", { At(0, -5, 1), At(1, -5, 1), At(-1, -5, 1) } },
    { "b", { At(4, -5, 1), At(5, -5, 1) } } };
  const std::string svg = DrawCameras(groups, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 1 } });
  EXPECT_EQ(CountParts(svg, "class=\"camera"), 10u) << "base and sides of each";
  EXPECT_EQ(CountParts(svg, "camera reference"), 2u);
  EXPECT_EQ(CountParts(svg, "class=\"label\""), 2u);
  EXPECT_NE(svg.find("5 cameras in 2 clusters"), std::string::npos);
}

TEST(CameraDrawing, StaysInItsFrame)
{
  const std::string svg =
    DrawCameras({ { "a", { At(0, -5, 1), At(20, -5, 7) } } }, { { 0, 0, 0 }, { 3, 3, 3 } });
  std::smatch box;
  ASSERT_TRUE(std::regex_search(svg, box, std::regex("viewBox=\"0 0 ([0-9]+) ([0-9]+)\"")));
  const std::vector<Eigen::Vector2d> points = Coordinates(svg);
  ASSERT_EQ(points.size(), 2u * (4 + 4 * 2) + 2)
    << "the base and four sides of each camera, and the points";
  for (const Eigen::Vector2d& point : points)
  {
    EXPECT_GE(point.minCoeff(), 0);
    EXPECT_LE(point.x(), NumberOf(box[1]));
    EXPECT_LE(point.y(), NumberOf(box[2]));
  }
}

TEST(CameraDrawing, HasLeftOnTheLeftAndFarAboveNear)
{
  const std::string svg = DrawCameras(
    { { "left", { At(-4, 0, 0) } }, { "right", { At(4, 0, 0) } }, { "far", { At(0, 8, 0) } } }, {});
  const std::regex label("<text[^>]* x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>(\\w+)<");
  std::map<std::string, Eigen::Vector2d> at;
  for (std::sregex_iterator i(svg.begin(), svg.end(), label), end; i != end; ++i)
  {
    at[(*i)[3]] = Eigen::Vector2d(NumberOf((*i)[1]), NumberOf((*i)[2]));
  }
  ASSERT_EQ(at.size(), 3u);
  EXPECT_LT(at["left"].x(), at["right"].x());
  EXPECT_LT(at["far"].y(), at["left"].y());
  EXPECT_LT(at["far"].y(), at["right"].y());
}

TEST(CameraDrawing, EscapesNames)
{
  const std::string svg = DrawCameras({ { "<b>\"&", { At(0, 0, 0) } } }, {});
  EXPECT_NE(svg.find("&lt;b&gt;&quot;&amp;"), std::string::npos);
}

TEST(CameraDrawing, TakesWhatIsDegenerate)
{
  EXPECT_EQ(DrawCameras({}, { { 0, 0, 0 } }), "");
  EXPECT_EQ(DrawCameras({ { "empty", {} } }, {}), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string one =
    DrawCameras({ { "one", { At(0, 0, 0) } }, { "empty", {} } }, { { nan, 0, 0 } });
  EXPECT_EQ(one.find("nan"), std::string::npos);
  EXPECT_EQ(one.find("inf"), std::string::npos);
  Camera down = At(0, 0, 0);
  down.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
  EXPECT_EQ(DrawCameras({ { "down", { down, down } } }, {}).find("nan"), std::string::npos);
}
