// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/NvmModel.h"

#include "Common/Error.h"
#include "SparseModel/SparseViews.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace freespace;

namespace
{

// What VisualSFM measures of a point: m (1 + r m^2) = u with u undistorted, in units of the focal
// length, by Newton's method.
double Measure(double undistorted, double r)
{
  double m = undistorted;
  for (int i = 0; i < 20; ++i)
  {
    m -= (m + r * m * m * m - undistorted) / (1 + 3 * r * m * m);
  }
  return m;
}

std::string NvmText(const SparseModel& model, double r)
{
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const SparseTracks tracks(model);
  std::ostringstream text;
  text.precision(17);
  text << "NVM_V3 \n\n" << images.size() << "\n";
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const auto& q = model.images[i].rotation;
    text << images[i].file << "\t" << images[i].camera.K(0, 0) << " " << q[0] << " " << q[1] << " "
         << q[2] << " " << q[3] << " " << images[i].camera.Center().transpose() << " " << r
         << " 0\n";
  }
  text << "\n" << model.points.size() << "\n";
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    const SparsePoint& point = model.points[i];
    text << point.position.transpose() << " 1 2 3 " << tracks.ofPoint[i].size();
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      const Eigen::Vector2d u = images[link.image].camera.FromWorld(point.position).hnormalized();
      const Eigen::Vector2d m = u * (Measure(u.norm(), r) / u.norm());
      text << " " << link.image << " " << link.observation << " " << (700 * m).transpose();
    }
    text << "\n";
  }
  text << "\n\n0\n#the last part of NVM file points to the PLY files\n0\n";
  return text.str();
}

void ExpectNvmError(const std::string& content, const std::vector<std::string>& words)
{
  TemporaryFolder folder;
  ExpectError([&] { ReadNvmModel(folder.Write("model.nvm", content)); }, words);
}

}

TEST(NvmModel, SeesWhatTheModelSaw)
{
  const SparseModel source = MakeSyntheticModel(4, 50, LensModel::SimplePinhole);
  for (const double r : { 0.0, 0.05, -0.05 })
  {
    TemporaryFolder folder;
    const SparseModel model = ReadNvmModel(folder.Write("model.nvm", NvmText(source, r)));
    ASSERT_EQ(model.images.size(), 4u);
    ASSERT_EQ(model.points.size(), 50u);
    SparseViewOptions options;
    options.maximumError = 0.5; // of the truncated series; there is no other
    const std::vector<SparseView> views = ViewsFromModel(model, options);
    ASSERT_EQ(views.size(), 4u);
    const std::vector<CalibratedImage> expected = CalibratedImages(source);
    std::size_t features = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(views[i].imageFile, expected[i].file);
      EXPECT_TRUE(views[i].camera.Center().isApprox(expected[i].camera.Center(), 1e-12));
      EXPECT_TRUE(views[i].camera.R.isApprox(expected[i].camera.R, 1e-12));
      features += views[i].points.size();
    }
    EXPECT_GT(features, 140u) << "r = " << r;
  }
}

TEST(NvmModel, BlanksInNames)
{
  TemporaryFolder folder;
  const SparseModel model =
    ReadNvmModel(folder.Write("model.nvm", "NVM_V3\n1\na\"b.jpg 500 1 0 0 0 1 2 3 0 0\n0\n"));
  EXPECT_EQ(model.images.at(0).name, "a b.jpg");
  EXPECT_EQ(CalibratedImages(model)[0].camera.Center(), Eigen::Vector3d(1, 2, 3));
}

// COLMAP's export: pixels from the upper left corner, names with blanks, and -k1 for the distortion.
TEST(NvmModel, PixelsFromTheCornerAreThoseOfColmap)
{
  for (const LensModel lens : { LensModel::SimplePinhole, LensModel::SimpleRadial })
  {
    const SparseModel source = MakeSyntheticModel(4, 50, lens);
    const SparseTracks tracks(source);
    std::ostringstream text;
    text.precision(17);
    text << "NVM_V3 \n \n4  \n";
    const std::vector<CalibratedImage> expected = CalibratedImages(source);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto& q = source.images[i].rotation;
      text << "my pictures/" << expected[i].file << " 700 " << q[0] << " " << q[1] << " " << q[2]
           << " " << q[3] << " " << expected[i].camera.Center().transpose() << " "
           << (lens == LensModel::SimpleRadial ? 0.1 : 0) << " 0\n";
    }
    text << "\n50\n";
    for (std::size_t i = 0; i < 50; ++i)
    {
      text << source.points[i].position.transpose() << " 1 2 3 " << tracks.ofPoint[i].size();
      for (const SparseLink& link : tracks.ofPoint[i])
      {
        text << " " << link.image << " " << link.observation << " "
             << source.images[link.image].observations[link.observation].pixel.transpose();
      }
      text << "\n";
    }
    TemporaryFolder folder;
    const SparseModel model = ReadNvmModel(folder.Write("model.nvm", text.str()));
    ASSERT_EQ(model.images.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(model.images[i].name, "my pictures/" + expected[i].file);
      EXPECT_EQ(model.cameras[i].model, lens);
      EXPECT_EQ(model.cameras[i].parameters, source.cameras[0].parameters);
      EXPECT_EQ(model.cameras[i].width, 800u);
      EXPECT_EQ(model.cameras[i].height, 600u);
      const CalibratedImage image = CalibratedImages(model)[i];
      EXPECT_TRUE(image.camera.Center().isApprox(expected[i].camera.Center(), 1e-12));
      for (const SparseObservation& observation : model.images[i].observations)
      {
        const Eigen::Vector3d& position = model.points[observation.point - 1].position;
        EXPECT_LT((ShowPoint(model, i, position) - observation.pixel).norm(), 1e-9);
      }
    }
  }
}

TEST(NvmModel, FixedCalibration)
{
  TemporaryFolder folder;
  const SparseModel model = ReadNvmModel(folder.Write("model.nvm",
    "NVM_V3 FixedK 500 320.5 510 240.25\n1\na.jpg 500 1 0 0 0 0 0 0 0 0\n"
    "1\n1 2 10 9 8 7 1 0 0 50 102\n"));
  EXPECT_EQ(model.cameras.at(0).model, LensModel::Pinhole);
  EXPECT_EQ(model.cameras[0].parameters, (std::vector<double>{ 500, 510, 320.5, 240.25 }));
  EXPECT_EQ(model.cameras[0].width, 641u);
  EXPECT_EQ(model.cameras[0].height, 481u);
  EXPECT_EQ(model.images.at(0).observations.at(0).pixel, Eigen::Vector2d(370.5, 342.25));
  EXPECT_LT(
    (ShowPoint(model, 0, { 1, 2, 10 }) - model.images[0].observations[0].pixel).norm(), 1e-12);
}

TEST(NvmModel, Malformed)
{
  ExpectNvmError("", { "model.nvm", "ends before" });
  ExpectNvmError("NVM_V2\n", { "line 1", "NVM_V3" });
  ExpectNvmError("NVM_V3 FixedK 1 2 3\n", { "line 1", "FixedK", "ends before" });
  ExpectNvmError("NVM_V3 FixedK 1 2 3 x\n", { "line 1", "'x'" });
  ExpectNvmError("NVM_V3 FixedK 1 2 3 4 0.5\n", { "line 1", "distortion", "not supported" });
  ExpectNvmError("NVM_V3 Free 1 2 3 4\n", { "line 1", "'Free'" });
  ExpectNvmError("NVM_V3\n1\na.jpg 500 0 0 0 0 1 2 3 0 0\n0\n", { "line 3", "pose" });
  ExpectNvmError("NVM_V3\n1\na.jpg 0 1 0 0 0 1 2 3 0 0\n0\n", { "focal length" });
  ExpectNvmError("NVM_V3\n1\na.jpg f 1 0 0 0 1 2 3 0 0\n0\n", { "line 3", "'f'" });
  ExpectNvmError("NVM_V3\n0\n1\n1 2 3 9 8 7 1 0 0 5 5\n", { "line 4", "no image 0" });
  ExpectNvmError("NVM_V3\n99999999999\n", { "ends before" });
  ExpectNvmError("NVM_V3\n0\n99999999999\n", { "ends before" });
}
