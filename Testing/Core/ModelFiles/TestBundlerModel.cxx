// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/BundlerModel.h"

#include "Common/Error.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace freespace;

namespace
{

// A model with lenses of the RADIAL kind as Bundler writes it: y up, looking along -z, pixels from the middle.
// COLMAP writes them from the middle of the lower left one.
std::string BundlerText(const SparseModel& model, bool fromCorner = false)
{
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const SparseTracks tracks(model);
  std::ostringstream text;
  text.precision(17);
  text << "# Bundle file v0.3\n" << images.size() << " " << model.points.size() << "\n";
  for (const CalibratedImage& image : images)
  {
    Eigen::Matrix3d R = image.camera.R;
    R.bottomRows(2) *= -1;
    const Eigen::Vector3d t = image.camera.t.cwiseProduct(Eigen::Vector3d(1, -1, -1));
    text << image.camera.K(0, 0) << " " << image.distortion[0] << " " << image.distortion[1] << "\n"
         << R << "\n"
         << t.transpose() << "\n";
  }
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    const SparsePoint& point = model.points[i];
    text << point.position.transpose() << "\n"
         << int(point.color[0]) << " " << int(point.color[1]) << " " << int(point.color[2]) << "\n"
         << tracks.ofPoint[i].size();
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      const Eigen::Vector2d pixel = model.images[link.image].observations[link.observation].pixel;
      text << " " << link.image << " " << link.observation << " "
           << pixel.x() - (fromCorner ? 0.5 : 400) << " "
           << (fromCorner ? 600 - 0.5 : 300) - pixel.y();
    }
    text << "\n";
  }
  return text.str();
}

void ExpectBundlerError(const std::string& content, const std::vector<std::string>& words)
{
  TemporaryFolder folder;
  ExpectError([&] { ReadBundlerModel(folder.Write("bundle.out", content)); }, words);
}

// Cameras see what they saw: every observation is where the lens shows its point.
void ExpectExactObservations(const SparseModel& model)
{
  const SparseTracks tracks(model);
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    EXPECT_EQ(tracks.ofPoint[i].size(), model.points[i].track.size());
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      const Eigen::Vector2d pixel = model.images[link.image].observations[link.observation].pixel;
      const auto image = static_cast<std::size_t>(link.image);
      EXPECT_LT((ShowPoint(model, image, model.points[i].position) - pixel).norm(), 1e-6);
    }
  }
}

}

TEST(BundlerModel, SeesWhatTheModelSaw)
{
  const SparseModel source = MakeSyntheticModel(4, 50, LensModel::Radial);
  TemporaryFolder folder;
  const SparseModel model = ReadBundlerModel(folder.Write("bundle.out", BundlerText(source)));
  ASSERT_EQ(model.images.size(), 4u);
  ASSERT_EQ(model.points.size(), 50u);
  ExpectExactObservations(model);
  const std::vector<CalibratedImage> expected = CalibratedImages(source);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(images[i].camera.Center().isApprox(expected[i].camera.Center(), 1e-12));
    EXPECT_TRUE(images[i].camera.R.isApprox(expected[i].camera.R, 1e-12));
    EXPECT_EQ(images[i].distortion, expected[i].distortion);
    EXPECT_EQ(images[i].file, "image" + std::to_string(i));
    EXPECT_LE(images[i].camera.width, 800);
    EXPECT_EQ(images[i].camera.K(0, 2), images[i].camera.width / 2.0);
    for (const SparseObservation& observation : model.images[i].observations)
    {
      EXPECT_TRUE(images[i].camera.Sees(observation.pixel)) << "outside of the guessed size";
    }
  }
  EXPECT_EQ(model.points[3].position, source.points[3].position);
  EXPECT_EQ(model.points[3].color, source.points[3].color);
}

TEST(BundlerModel, NamesFromTheList)
{
  const std::string text = BundlerText(MakeSyntheticModel(2, 5, LensModel::Radial));
  for (const std::string list : { "list.txt", "bundle/list.txt" })
  {
    TemporaryFolder folder;
    folder.Write(list, "./pictures/a.jpg 0 660.8\n./pictures/b.jpg\n");
    const SparseModel model = ReadBundlerModel(folder.Write("bundle/bundle.out", text));
    EXPECT_EQ(model.images[0].name, "./pictures/a.jpg");
    EXPECT_EQ(model.images[1].name, "./pictures/b.jpg");
  }
}

TEST(BundlerModel, ListsOfColmapAndVisualSFM)
{
  const std::string text = BundlerText(MakeSyntheticModel(2, 5, LensModel::Radial));
  const std::pair<const char*, const char*> names[] = { { "scene.bundle.out", "scene.list.txt" },
    { "scene.out", "scene.list.txt" }, { "scene.out", "scene.out.list.txt" },
    { "scene.bundle.out", "scene.bundle.list.txt" } };
  for (const auto& [file, list] : names)
  {
    TemporaryFolder folder;
    folder.Write("list.txt", "of.jpg\nanother.jpg\n");
    folder.Write(list,
      "\xEF\xBB\xBF"
      "a picture.jpg\nmy pictures/b 0 1.jpg 0 660.8\n");
    const SparseModel model = ReadBundlerModel(folder.Write(file, text));
    EXPECT_EQ(model.images[0].name, "a picture.jpg") << file << " " << list;
    EXPECT_EQ(model.images[1].name, "my pictures/b 0 1.jpg");
  }
}

// As COLMAP's model_converter writes it.
TEST(BundlerModel, PixelsFromTheCornerAreThoseOfColmap)
{
  const SparseModel source = MakeSyntheticModel(4, 50, LensModel::Radial);
  TemporaryFolder folder;
  const SparseModel model =
    ReadBundlerModel(folder.Write("a.bundle.out", BundlerText(source, true)));
  ASSERT_EQ(model.images.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(model.cameras[i].parameters, source.cameras[0].parameters);
    EXPECT_EQ(model.cameras[i].width, 800u);
    EXPECT_EQ(model.cameras[i].height, 600u);
  }
  ExpectExactObservations(model);
}

TEST(BundlerModel, ListThatIsTooShort)
{
  TemporaryFolder folder;
  folder.Write("list.txt", "a.jpg\n");
  const std::string text = BundlerText(MakeSyntheticModel(2, 5, LensModel::Radial));
  EXPECT_THROW(ReadBundlerModel(folder.Write("bundle.out", text)), Error);
}

TEST(BundlerModel, CamerasThatWereNotPlacedAreLeftOut)
{
  TemporaryFolder folder;
  const SparseModel model = ReadBundlerModel(folder.Write("bundle.out",
    "# Bundle file v0.3\n2 1\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n"
    "500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n1 2 -5\n9 8 7\n2 0 0 1 1 1 0 10 -20\n"));
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].name, "image1");
  ASSERT_EQ(model.points[0].track.size(), 1u);
  EXPECT_EQ(model.points[0].track[0].image, model.images[0].id);
  // y up becomes y down, -z becomes +z.
  EXPECT_EQ(CalibratedImages(model)[0].camera.FromWorld({ 1, 2, -5 }), Eigen::Vector3d(1, -2, 5));
}

TEST(BundlerModel, Malformed)
{
  ExpectBundlerError("", { "bundle.out", "ends before" });
  ExpectBundlerError("# Bundle file v0.3\n1 0\n500 0 zero\n", { "line 3", "'zero'" });
  ExpectBundlerError("1 0\n500 0 0\n1 0 0\n0 2 0\n0 0 1\n0 0 0\n", { "camera 0", "rotation" });
  ExpectBundlerError("0 1\n1 2 3\n9 8 7\n1 0 0 1 1\n", { "line 4", "no image 0" });
  ExpectBundlerError("0 1\n1 nan 3\n9 8 7\n0\n", { "not finite" });
  ExpectBundlerError("0 1\n1 2 3\n9 8 700\n0\n", { "line 3", "'700'" });
  ExpectBundlerError("1 0\n-500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n", { "focal length" });
  ExpectBundlerError("99999999999 99999999999\n", { "ends before" });
}

TEST(BundlerModel, TruncatedAnywhere)
{
  const std::string text = BundlerText(MakeSyntheticModel(2, 3, LensModel::Radial));
  TemporaryFolder folder;
  for (std::size_t length = 0; length + 30 < text.size(); length += 5) // not within the last number
  {
    EXPECT_THROW(ReadBundlerModel(folder.Write("bundle.out", text.substr(0, length))), Error);
  }
}
