// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/CameraDrawing.h"

#include "Report/Page/Html.h"
#include "Viewpoints/CommonUp.h"
#include "Viewpoints/NovelCameras.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace freespace
{

namespace
{

constexpr double drawingWidth = 960;
constexpr double mostHeight = 680;
constexpr double margin = 34;
constexpr std::size_t mostPoints = 6000;

/// Parallel projection of the world to the plane of the drawing, x right and y down.
class Projection
{
public:
  explicit Projection(const std::vector<Camera>& cameras)
  {
    const Eigen::Vector3d up = CommonUp(cameras);
    // From behind the first camera, turned aside so that a ring of cameras opens, and from above.
    Eigen::Vector3d front = cameras[0].R.row(2).transpose();
    front -= front.dot(up) * up;
    front = front.norm() > 1e-3 ? front.normalized() : up.unitOrthogonal();
    front = Eigen::AngleAxisd(0.35, up) * front;
    const Eigen::Vector3d forward = (front - 1.7 * up).normalized(); // 60 degrees down
    this->Right = forward.cross(up).normalized();
    this->Down = forward.cross(this->Right);
  }

  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const
  {
    return { this->Right.dot(point), this->Down.dot(point) };
  }

private:
  Eigen::Vector3d Right;
  Eigen::Vector3d Down;
};

/// The apex of a camera's pyramid and the corners of its base.
struct Pyramid
{
  Eigen::Vector2d apex;
  std::array<Eigen::Vector2d, 4> corners;
};

Pyramid MakePyramid(const Camera& camera, double depth, const Projection& project)
{
  const double w = camera.width;
  const double h = camera.height;
  Pyramid pyramid;
  pyramid.apex = project(camera.Center());
  const Eigen::Vector2d pixels[4] = { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } };
  for (int i = 0; i < 4; ++i)
  {
    pyramid.corners[i] = project(camera.Unproject(pixels[i], depth));
  }
  return pyramid;
}

// As far from the middle as the cameras are, of which the pyramids take a small part.
double PyramidDepth(const std::vector<Camera>& cameras, const Eigen::Vector3d& middle)
{
  double sum = 0;
  for (const Camera& camera : cameras)
  {
    sum += (camera.Center() - middle).norm() / cameras.size();
  }
  return 0.14 * sum;
}

/// Scales the drawing to its width or, where that would be too high, to its height.
struct Frame
{
  Eigen::AlignedBox2d box;

  double Scale() const
  {
    const Eigen::Vector2d size = this->box.sizes().cwiseMax(1e-12);
    return std::min((drawingWidth - 2 * margin) / size.x(), (mostHeight - 2 * margin) / size.y());
  }
  double Height() const { return this->box.sizes().y() * this->Scale() + 2 * margin; }
  std::string At(const Eigen::Vector2d& point) const
  {
    const Eigen::Vector2d middle(drawingWidth / 2, this->Height() / 2);
    const Eigen::Vector2d at = (point - this->box.center()) * this->Scale() + middle;
    char text[64];
    std::snprintf(text, sizeof(text), "%.1f %.1f", at.x(), at.y());
    return text;
  }
};

std::vector<Eigen::Vector3d> Sample(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<Eigen::Vector3d> sample;
  const std::size_t step = points.size() / mostPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += step)
  {
    if (points[i].allFinite())
    {
      sample.push_back(points[i]);
    }
  }
  return sample;
}

// The box of the cameras and of all points but the few distant ones.
Eigen::AlignedBox2d BoxOf(
  const std::vector<Pyramid>& pyramids, const std::vector<Eigen::Vector2d>& points)
{
  Eigen::AlignedBox2d box;
  for (const Pyramid& pyramid : pyramids)
  {
    box.extend(pyramid.apex);
    for (const Eigen::Vector2d& corner : pyramid.corners)
    {
      box.extend(corner);
    }
  }
  for (int axis = 0; axis < 2 && !points.empty(); ++axis)
  {
    std::vector<double> values;
    for (const Eigen::Vector2d& point : points)
    {
      values.push_back(point[axis]);
    }
    std::sort(values.begin(), values.end());
    const std::size_t tail = values.size() / 50;
    box.min()[axis] = std::min(box.min()[axis], values[tail]);
    box.max()[axis] = std::max(box.max()[axis], values[values.size() - 1 - tail]);
  }
  return box;
}

// The middle of a group's upper side, where its label stands.
Eigen::Vector2d TopOf(const std::vector<Pyramid>& pyramids, std::size_t first, std::size_t count)
{
  const auto begin = pyramids.begin() + first;
  const Eigen::AlignedBox2d box = BoxOf(std::vector<Pyramid>(begin, begin + count), {});
  return count > 0 ? Eigen::Vector2d(box.center().x(), box.min().y()) : Eigen::Vector2d::Zero();
}

std::string Dots(const std::vector<Eigen::Vector2d>& points, const Frame& frame)
{
  std::string path;
  for (const Eigen::Vector2d& point : points)
  {
    if (frame.box.contains(point))
    {
      path += "M" + frame.At(point) + "h0";
    }
  }
  return "<path class=\"point\" d=\"" + path + "\"/>\n";
}

std::string Outline(const Pyramid& pyramid, const Frame& frame, bool isReference)
{
  std::string base = "M" + frame.At(pyramid.corners[0]);
  std::string sides;
  for (int i = 1; i < 4; ++i)
  {
    base += "L" + frame.At(pyramid.corners[i]);
  }
  for (const Eigen::Vector2d& corner : pyramid.corners)
  {
    sides += "M" + frame.At(pyramid.apex) + "L" + frame.At(corner);
  }
  return "<path class=\"camera" + std::string(isReference ? " reference" : "") + "\" d=\"" + base +
    "Z\"/><path class=\"camera\" d=\"" + sides + "\"/>\n";
}

}

std::string GroupColor(std::size_t group, std::size_t count)
{
  const int hue = static_cast<int>(205 + 360 * group / std::max<std::size_t>(count, 1)) % 360;
  return "hsl(" + std::to_string(hue) + " 70% 48%)";
}

std::string DrawCameras(
  const std::vector<CameraGroup>& groups, const std::vector<Eigen::Vector3d>& points)
{
  std::vector<Camera> cameras;
  for (const CameraGroup& group : groups)
  {
    cameras.insert(cameras.end(), group.cameras.begin(), group.cameras.end());
  }
  if (cameras.empty())
  {
    return "";
  }
  const Projection project(cameras);
  const double depth = PyramidDepth(cameras, MedianPoint(points));
  std::vector<Pyramid> pyramids;
  for (const Camera& camera : cameras)
  {
    pyramids.push_back(MakePyramid(camera, depth, project));
  }
  std::vector<Eigen::Vector2d> dots;
  for (const Eigen::Vector3d& point : Sample(points))
  {
    dots.push_back(project(point));
  }
  const Frame frame{ BoxOf(pyramids, dots) };
  const std::string size =
    std::to_string(int(drawingWidth)) + " " + std::to_string(int(std::ceil(frame.Height())));
  std::string svg = "<svg viewBox=\"0 0 " + size + "\" role=\"img\" aria-label=\"" +
    std::to_string(cameras.size()) + " cameras in " + std::to_string(groups.size()) +
    " clusters around the features of the scene\">\n";
  svg += Dots(dots, frame);
  std::size_t next = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    svg += "<g style=\"--group:" + GroupColor(g, groups.size()) + "\">\n";
    const Eigen::Vector2d label = TopOf(pyramids, next, groups[g].cameras.size());
    for (std::size_t i = 0; i < groups[g].cameras.size(); ++i)
    {
      svg += Outline(pyramids[next++], frame, i == 0);
    }
    const std::string at = frame.At(label);
    const std::size_t space = at.find(' ');
    svg += "<text class=\"label\" x=\"" + at.substr(0, space) + "\" y=\"" + at.substr(space + 1) +
      "\" dy=\"-12\">" + EscapeHtml(groups[g].name) + "</text>\n</g>\n";
  }
  return svg + "</svg>";
}

}
