// SPDX-License-Identifier: BSD-3-Clause

// Free space of range images against OctoMap's of the same scans: time and memory to insert them, time of
// queries, and how many answers are right, for a room with balls whose truth is known.
//
//   BenchmarkDepthMaps [WIDTH] [SCANS] [RESOLUTION]

#include "Common/ParseNumber.h"
#include "Depth/DepthFeatures.h"
#include "Disparity/DelaunayDisparity.h"
#include "Freespace/FreespaceUnion.h"

#include <octomap/octomap.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <malloc.h>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A room of half side 2 with three balls in it.
struct Ball
{
  Vector3d center;
  double radius;
};
const Ball balls[] = { { { 0.6, 0.2, -1.2 }, 0.5 }, { { -0.7, 0.8, -1 }, 0.4 },
  { { 0, -0.9, -0.6 }, 0.6 } };
constexpr double half = 2;

bool IsMatter(const Vector3d& x)
{
  for (const Ball& ball : balls)
  {
    if ((x - ball.center).norm() < ball.radius)
    {
      return true;
    }
  }
  return x.cwiseAbs().maxCoeff() > half;
}

// Distance from inside the room along a unit vector.
double Range(const Vector3d& from, const Vector3d& along)
{
  double range = 1e30;
  for (int k = 0; k < 3; ++k)
  {
    range = std::min(range, ((along[k] > 0 ? half : -half) - from[k]) / along[k]);
  }
  for (const Ball& ball : balls)
  {
    const double b = along.dot(from - ball.center);
    const double root = b * b - (from - ball.center).squaredNorm() + ball.radius * ball.radius;
    if (root > 0 && -b - std::sqrt(root) > 0)
    {
      range = std::min(range, -b - std::sqrt(root));
    }
  }
  return range;
}

struct Scan
{
  CalibratedImage image;
  DepthMap map;
};

// Scanners on a circle near the walls that look to the middle.
std::vector<Scan> MakeScans(int count, int width)
{
  std::vector<Scan> scans(static_cast<std::size_t>(count));
  for (int s = 0; s < count; ++s)
  {
    Scan& scan = scans[static_cast<std::size_t>(s)];
    Camera& camera = scan.image.camera;
    scan.image.file = std::to_string(s);
    camera.width = width;
    camera.height = width * 3 / 4;
    camera.K << 0.6 * width, 0, width / 2.0, 0, 0.6 * width, camera.height / 2.0, 0, 0, 1;
    const double angle = 2 * M_PI * s / count;
    const Vector3d center(1.7 * std::cos(angle), 1.7 * std::sin(angle), 0.5);
    const Vector3d z = (Vector3d(0, 0, -0.8) - center).normalized();
    const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
    camera.R << x.transpose(), z.cross(x).transpose(), z.transpose();
    camera.t = -camera.R * center;
    scan.map = { camera.width, camera.height, {} };
    for (int row = 0; row < camera.height; ++row)
    {
      for (int column = 0; column < camera.width; ++column)
      {
        const Vector3d ray = camera.K.inverse() * Vector3d(column + 0.5, row + 0.5, 1);
        scan.map.depths.push_back(
          static_cast<float>(Range(center, camera.R.transpose() * ray.normalized())));
      }
    }
  }
  return scans;
}

// Of the processor, since both sides run in one thread.
double Seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double Megabytes()
{
  malloc_trim(0);
  return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd) / (1 << 20);
}

enum class Answer
{
  Free,
  Matter,
  Unknown
};

template <typename Ask>
void Report(const char* name, double seconds, double megabytes, std::size_t elements,
  const std::vector<Vector3d>& points, const Ask& ask)
{
  std::vector<Answer> answers(points.size());
  const double begin = Seconds();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    answers[i] = ask(points[i]);
  }
  const double each = (Seconds() - begin) / static_cast<double>(points.size());
  std::size_t wrongFree = 0, wrongMatter = 0, unknown = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    wrongFree += answers[i] == Answer::Free && IsMatter(points[i]);
    wrongMatter += answers[i] == Answer::Matter && !IsMatter(points[i]);
    unknown += answers[i] == Answer::Unknown;
  }
  const auto percent = [&](std::size_t n)
  { return 100.0 * static_cast<double>(n) / static_cast<double>(points.size()); };
  std::printf("%-22s %8.3f %9.1f %10zu %8.0f %10.2f %12.2f %8.2f\n", name, seconds, megabytes,
    elements, 1e9 * each, percent(wrongFree), percent(wrongMatter), percent(unknown));
  std::fflush(stdout);
}

void RunFreespace(const char* name, const std::vector<Scan>& scans, int largestBlock,
  const std::vector<Vector3d>& points)
{
  const double before = Megabytes(), begin = Seconds();
  std::size_t features = 0;
  FreespaceUnion phi = [&]
  {
    DepthOptions options;
    options.isRange = true;
    options.largestBlock = largestBlock;
    options.relativeDeviation = 0.002;
    std::vector<View> views;
    for (const Scan& scan : scans)
    {
      views.push_back(FeaturesOfDepthMap(scan.image, scan.map, options));
      features += views.back().points.size();
    }
    return FreespaceUnion(TriangulateViews(views, {}), {});
  }();
  const double seconds = Seconds() - begin;
  Report(name, seconds, Megabytes() - before, features, points,
    [&](const Vector3d& x) { return phi.IsFree(x) ? Answer::Free : Answer::Matter; });
}

void RunOctoMap(
  const std::vector<Scan>& scans, double resolution, const std::vector<Vector3d>& points)
{
  const double before = Megabytes(), begin = Seconds();
  octomap::OcTree tree(resolution);
  for (const Scan& scan : scans)
  {
    const Camera& camera = scan.image.camera;
    const Vector3d center = camera.Center();
    octomap::Pointcloud cloud;
    std::size_t i = 0;
    for (int row = 0; row < camera.height; ++row)
    {
      for (int column = 0; column < camera.width; ++column)
      {
        const Vector3d ray = camera.K.inverse() * Vector3d(column + 0.5, row + 0.5, 1);
        const Vector3d x =
          center + scan.map.depths[i++] * (camera.R.transpose() * ray.normalized());
        cloud.push_back(
          static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z()));
      }
    }
    tree.insertPointCloud(cloud,
      octomap::point3d(static_cast<float>(center.x()), static_cast<float>(center.y()),
        static_cast<float>(center.z())));
  }
  tree.prune();
  const double seconds = Seconds() - begin;
  char name[40];
  std::snprintf(name, sizeof(name), "OctoMap %g", resolution);
  Report(name, seconds, Megabytes() - before, tree.size(), points,
    [&](const Vector3d& x)
    {
      const octomap::OcTreeNode* node = tree.search(x.x(), x.y(), x.z());
      return !node ? Answer::Unknown : tree.isNodeOccupied(node) ? Answer::Matter : Answer::Free;
    });
}

}

int main(int argc, char** argv)
{
  const auto width = ParseNumber<int>(argc > 1 ? argv[1] : "320");
  const auto count = ParseNumber<int>(argc > 2 ? argv[2] : "8");
  const auto resolution = ParseNumber<double>(argc > 3 ? argv[3] : "0.02");
  if (!(width && count && resolution && *width > 1 && *count > 0 && *resolution > 0))
  {
    std::fprintf(stderr, "Usage: BenchmarkDepthMaps [WIDTH] [SCANS] [RESOLUTION]\n");
    return 2;
  }
  const double finest = *resolution;
  const std::vector<Scan> scans = MakeScans(*count, *width);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1.9, 1.9);
  std::vector<Vector3d> points(200000);
  for (Vector3d& point : points)
  {
    point = { coordinate(random), coordinate(random), coordinate(random) };
  }
  std::printf("%d scans of %d x %d\n%-22s %8s %9s %10s %8s %10s %12s %8s\n", *count, *width,
    *width * 3 / 4, "", "s", "MB", "elements", "ns/query", "% in balls", "% not freed",
    "% unknown");
  RunFreespace("freespace, blocks", scans, 16, points);
  RunFreespace("freespace, each pixel", scans, 1, points);
  RunOctoMap(scans, 2 * finest, points);
  RunOctoMap(scans, finest, points);
  return 0;
}
