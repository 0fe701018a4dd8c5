// SPDX-License-Identifier: BSD-3-Clause

// What a triplet of the blocks scene costs, from decoded images to matches (edges of three images
// and their matching), beside OpenCV's StereoSGBM (MODE_SGBM_3WAY) on the rectified colour pair of its
// reference and left image: the same disparity range, one thread each, taken in turn. SGBM is spared
// the rectification, ours works without. The counter `ratio` is ours / SGBM's.
//
// The first argument is 0 for the range that the cameras see in common (the default of
// vtkEdgeStereoReader), of which SGBM does only the columns that have all disparities within the
// image (`columns` of them), and 1 for the depths 0.7 m to 1.5 m. The second one is how many triplets
// of the cross are matched together, which then share the edges of the reference: `ratio` is that of
// one of them.
//
//   BenchmarkEdgeStereo

#include "Epipolar/DisparityRange.h"
#include "Images/ImageFile.h"
#include "Matching/TrinocularMatcher.h"
#include "Scene/Scene.h"
#include "Support/SharedData.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <iterator>
#include <limits>

using namespace freespace;

namespace
{

struct CameraImage
{
  Camera camera;
  cv::Mat pixels;
};

// The images of the first cluster's first triplets: the reference, then the others in pairs.
std::vector<CameraImage> ReadImages(const std::string& sceneFile, int triplets)
{
  const Scene scene = ReadScene(sceneFile);
  const Cluster& cluster = scene.clusters.at(0);
  std::vector<std::string> files{ cluster.reference };
  for (int i = 0; i < triplets; ++i)
  {
    files.push_back(cluster.triplets.at(i)[0]);
    files.push_back(cluster.triplets.at(i)[2]);
  }
  std::vector<CameraImage> read;
  const std::vector<CalibratedImage> calibrated = ReadSceneImages(scene);
  for (const std::string& file : files)
  {
    const auto image = std::find_if(calibrated.begin(), calibrated.end(),
      [&](const CalibratedImage& candidate) { return candidate.file == file; });
    const Camera& camera = image->camera;
    read.push_back({ camera, LoadImage(scene.ImagePath(file), camera.width, camera.height) });
  }
  return read;
}

// The reference and the left image, rectified, and the disparities in pixels for a range of depths.
struct RectifiedPair
{
  cv::Mat left, right;
  int minimum = 0;
  int count = 16;
};

cv::Mat ToMat(const Eigen::MatrixXd& matrix)
{
  cv::Mat result(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), CV_64F);
  for (int row = 0; row < result.rows; ++row)
  {
    for (int column = 0; column < result.cols; ++column)
    {
      result.at<double>(row, column) = matrix(row, column);
    }
  }
  return result;
}

RectifiedPair Rectify(
  const CameraImage& leftImage, const CameraImage& referenceImage, const DisparityRange& range)
{
  const Camera &left = leftImage.camera, &reference = referenceImage.camera;
  const Eigen::Matrix3d rotation = reference.R * left.R.transpose();
  const Eigen::Vector3d translation = reference.t - rotation * left.t;
  const cv::Size size(reference.width, reference.height);
  const cv::Mat leftK = ToMat(left.K), referenceK = ToMat(reference.K);
  cv::Mat R1, R2, P1, P2, Q, mapX, mapY;
  cv::stereoRectify(leftK, cv::noArray(), referenceK, cv::noArray(), size, ToMat(rotation),
    ToMat(translation), R1, R2, P1, P2, Q, cv::CALIB_ZERO_DISPARITY, 0);
  RectifiedPair pair;
  cv::initUndistortRectifyMap(leftK, cv::noArray(), R1, P1, size, CV_32F, mapX, mapY);
  cv::remap(leftImage.pixels, pair.left, mapX, mapY, cv::INTER_LINEAR);
  cv::initUndistortRectifyMap(referenceK, cv::noArray(), R2, P2, size, CV_32F, mapX, mapY);
  cv::remap(referenceImage.pixels, pair.right, mapX, mapY, cv::INTER_LINEAR);
  const double perDisparity = std::abs(P2.at<double>(0, 3));
  pair.minimum = static_cast<int>(std::floor(perDisparity * range.minimum));
  const double count = std::min<double>(size.width, perDisparity * range.maximum) - pair.minimum;
  pair.count = 16 * static_cast<int>(std::ceil(count / 16));
  return pair;
}

// Of this thread's work, so that other programs disturb it less.
double Seconds(const std::function<void()>& work)
{
  const auto now = []()
  {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

void TripletAgainstSGBM(benchmark::State& state)
{
  const std::string scene = SharedData("blocks/scene.json");
  if (scene.empty())
  {
    state.SkipWithError("The blocks scene is not there.");
    return;
  }
  cv::setNumThreads(1);
  const int triplets = static_cast<int>(state.range(1));
  const std::vector<CameraImage> images = ReadImages(scene, triplets);
  DisparityRange range{ 1 / 1.5, 1 / 0.7 };
  if (state.range(0) == 0)
  {
    range = CommonRange(images[0].camera, images[1].camera, images[2].camera,
      { 0, std::numeric_limits<double>::infinity() });
  }
  MatcherOptions options;
  options.minimumDisparity = range.minimum;
  options.maximumDisparity = range.maximum;
  const RectifiedPair pair = Rectify(images[1], images[0], range);
  constexpr int block = 5, smooth = 3 * block * block;
  const auto sgbm = cv::StereoSGBM::create(pair.minimum, pair.count, block, 8 * smooth, 32 * smooth,
    1, 63, 10, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  double ours = 0, theirs = 0;
  std::size_t matches = 0;
  for (auto _ : state)
  {
    ours += Seconds(
      [&]()
      {
        const auto edgesOf = [](const CameraImage& image) {
          return ImageEdges{ image.camera, FindEdges(image.pixels, EdgeTokenOptions()) };
        };
        const ImageEdges reference = edgesOf(images[0]);
        std::vector<ImageEdges> others;
        std::transform(images.begin() + 1, images.end(), std::back_inserter(others), edgesOf);
        const auto all = MatchEdges(reference, others, options);
        matches = std::count_if(
          all.begin(), all.end(), [](const EdgeMatch& match) { return match.images > 0; });
      });
    cv::Mat disparity;
    theirs += Seconds([&]() { sgbm->compute(pair.left, pair.right, disparity); });
  }
  ours /= triplets;
  state.counters["ratio"] = ours / theirs;
  state.counters["ours_ms"] = 1e3 * ours / state.iterations();
  state.counters["sgbm_ms"] = 1e3 * theirs / state.iterations();
  state.counters["disparities"] = pair.count;
  state.counters["columns"] = pair.left.cols - pair.minimum - pair.count;
  state.counters["matches"] = static_cast<double>(matches);
}
BENCHMARK(TripletAgainstSGBM)
  ->ArgNames({ "range", "triplets" })
  ->ArgsProduct({ { 0, 1 }, { 1, 2 } })
  ->Iterations(10)
  ->Unit(benchmark::kMillisecond);

}

BENCHMARK_MAIN();
