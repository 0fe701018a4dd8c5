// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ModelBuilder.h"

#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{

SparseCamera CameraOfLength(double focalLength)
{
  SparseCamera camera = PerspectiveCamera(focalLength, focalLength, 320, 240, {});
  camera.width = 640;
  camera.height = 480;
  return camera;
}

Matrix3d SomeRotation()
{
  return Eigen::AngleAxisd(0.7, Vector3d(1, -2, 3).normalized()).toRotationMatrix();
}

}

TEST(ModelBuilder, TheSimplestLensThatHasTheCoefficients)
{
  const auto expect = [](double fy, const std::vector<double>& distortion, LensModel model,
                        const std::vector<double>& parameters)
  {
    const SparseCamera camera = PerspectiveCamera(500, fy, 320, 240, distortion);
    EXPECT_EQ(camera.model, model);
    EXPECT_EQ(camera.parameters, parameters);
  };
  expect(500, {}, LensModel::SimplePinhole, { 500, 320, 240 });
  expect(500, { 0, 0, 0, 0, 0 }, LensModel::SimplePinhole, { 500, 320, 240 });
  expect(500, { 0.1 }, LensModel::SimpleRadial, { 500, 320, 240, 0.1 });
  expect(500, { 0, 0.2 }, LensModel::Radial, { 500, 320, 240, 0, 0.2 });
  expect(501, {}, LensModel::Pinhole, { 500, 501, 320, 240 });
  expect(501, { 0.1 }, LensModel::OpenCV, { 500, 501, 320, 240, 0.1, 0, 0, 0 });
  expect(500, { 0.1, 0, 0.01 }, LensModel::OpenCV, { 500, 500, 320, 240, 0.1, 0, 0.01, 0 });
  expect(500, { 0.1, 0.2, 0.3, 0.4, 0.5 }, LensModel::FullOpenCV,
    { 500, 500, 320, 240, 0.1, 0.2, 0.3, 0.4, 0.5, 0, 0, 0 });
}

TEST(ModelBuilder, CamerasThatAreAlikeAreOne)
{
  ModelBuilder builder("cameras.xml", "images");
  EXPECT_EQ(builder.AddCamera(CameraOfLength(500)), 1u);
  EXPECT_EQ(builder.AddCamera(CameraOfLength(600)), 2u);
  EXPECT_EQ(builder.AddCamera(CameraOfLength(500)), 1u);
  SparseCamera wider = CameraOfLength(500);
  wider.width = 641;
  EXPECT_EQ(builder.AddCamera(wider), 3u);
  const SparseModel model = builder.Take();
  EXPECT_EQ(model.folder, "images");
  ASSERT_EQ(model.cameras.size(), 3u);
  EXPECT_EQ(model.cameras[2].id, 3u);
  EXPECT_EQ(model.cameras[2].width, 641u);
}

TEST(ModelBuilder, PosesAreOfCentres)
{
  ModelBuilder builder("cameras.xml", "");
  const std::uint32_t camera = builder.AddCamera(CameraOfLength(500));
  const Vector3d center(3, -4, 5);
  EXPECT_EQ(builder.AddImage("a.jpg", camera, SomeRotation(), center), 1u);
  const SparseModel model = builder.Take();
  const Camera posed = CalibratedImages(model).at(0).camera;
  EXPECT_LT((posed.Center() - center).norm(), 1e-12);
  EXPECT_LT((posed.R - SomeRotation()).norm(), 1e-12);
}

TEST(ModelBuilder, ObservationsAndTracksNameEachOther)
{
  ModelBuilder builder("cameras.xml", "");
  const std::uint32_t camera = builder.AddCamera(CameraOfLength(500));
  const std::uint32_t a = builder.AddImage("a.jpg", camera, SomeRotation(), { 0, 0, 0 });
  const std::uint32_t b = builder.AddImage("b.jpg", camera, SomeRotation(), { 1, 0, 0 });
  builder.AddPoint({ 1, 2, 3 }, { 10, 20, 30 });
  builder.AddObservation(b, { 5, 6 });
  builder.AddPoint({ 4, 5, 6 }, { 0, 0, 0 });
  builder.AddObservation(a, { 7, 8 });
  builder.AddObservation(b, { 9, 10 });
  const SparseModel model = builder.Take();
  ASSERT_EQ(model.points.size(), 2u);
  EXPECT_EQ(model.points[0].color, (std::array<std::uint8_t, 3>{ 10, 20, 30 }));
  for (const SparsePoint& point : model.points)
  {
    EXPECT_FALSE(point.track.empty());
    for (const SparseTrackElement& element : point.track)
    {
      const SparseImage& image = model.images.at(element.image - 1);
      EXPECT_EQ(image.id, element.image);
      EXPECT_EQ(image.observations.at(element.observation).point, point.id);
    }
  }
  ASSERT_EQ(model.images[1].observations.size(), 2u);
  EXPECT_EQ(model.images[1].observations[1].pixel, Eigen::Vector2d(9, 10));
}

TEST(ModelBuilder, ARotationMayBeOffByRounding)
{
  ModelBuilder builder("cameras.xml", "");
  const std::uint32_t camera = builder.AddCamera(CameraOfLength(500));
  builder.AddImage("a.jpg", camera, (1 + 1e-4) * SomeRotation(), { 1, 2, 3 });
  const Eigen::Matrix3d read = CalibratedImages(builder.Take()).at(0).camera.R;
  EXPECT_LT((read - SomeRotation()).norm(), 2e-4);
  EXPECT_LT((read * read.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12)
    << "it is a rotation";
}

TEST(ModelBuilder, FaultsNameTheFileAndTheImage)
{
  ModelBuilder builder("cameras.xml", "");
  const std::uint32_t camera = builder.AddCamera(CameraOfLength(500));
  const auto add = [&](const char* name, const Matrix3d& rotation, const Vector3d& center)
  {
    return [&builder, camera, name, rotation, center]
    { builder.AddImage(name, camera, rotation, center); };
  };
  ExpectError(add("large.jpg", 1.1 * SomeRotation(), { 0, 0, 0 }),
    { "cameras.xml", "large.jpg", "rotation" });
  ExpectError(
    add("mirror.jpg", -SomeRotation(), { 0, 0, 0 }), { "cameras.xml", "mirror.jpg", "rotation" });
  ExpectError(add("nan.jpg", Matrix3d::Constant(NAN), { 0, 0, 0 }), { "cameras.xml", "nan.jpg" });
  ExpectError(add("far.jpg", SomeRotation(), { NAN, 0, 0 }), { "cameras.xml" });
  builder.AddImage("a.jpg", camera, SomeRotation(), { 0, 0, 0 });
  ExpectError(add("a.jpg", SomeRotation(), { 1, 0, 0 }), { "cameras.xml", "two images", "a.jpg" });
  ExpectError([&] { builder.AddPoint({ 0, INFINITY, 0 }, { 0, 0, 0 }); }, { "cameras.xml" });
  ExpectError([&] { builder.AddCamera(CameraOfLength(NAN)); }, { "cameras.xml" });
  ExpectError([&] { builder.Fail("it is empty"); }, { "Cannot read cameras.xml: it is empty." });
}
