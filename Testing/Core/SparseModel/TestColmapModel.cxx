// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapModel.h"

#include "Common/Error.h"
#include "Support/ExpectSameModel.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ColmapImage.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

using namespace freespace;

namespace
{

const std::string textCameras = "# a comment\n"
                                "1 PINHOLE 640 480 500 510 320.5 240.25\n"
                                "7 SIMPLE_RADIAL 800 600 700 400 300 -0.1\n";
const std::string textImages = "# a comment\n\n"
                               "3 0.5 0.5 0.5 0.5 1 2 3 7 folder/a picture.jpg\n"
                               "10.5 20.25 5 30 40 -1\n"
                               "4 1 0 0 0 0 0 0 1 b.jpg\n"
                               "\n";
const std::string textPoints = "5 0.25 -1e-3 4 255 0 128 0.75 3 0\n";

class BinaryFile
{
public:
  template <typename Value>
  BinaryFile& operator<<(Value value)
  {
    this->Content.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  BinaryFile& Text(const char* text)
  {
    this->Content.append(text, std::strlen(text) + 1);
    return *this;
  }
  std::string Content;
};

// The same model as the text.
std::string BinaryCameras()
{
  BinaryFile file;
  file << std::uint64_t(2);
  file << std::uint32_t(1) << std::int32_t(1) << std::uint64_t(640) << std::uint64_t(480) << 500.0
       << 510.0 << 320.5 << 240.25;
  file << std::uint32_t(7) << std::int32_t(2) << std::uint64_t(800) << std::uint64_t(600) << 700.0
       << 400.0 << 300.0 << -0.1;
  return file.Content;
}

std::string BinaryImages()
{
  BinaryFile file;
  file << std::uint64_t(2);
  file << std::uint32_t(3) << 0.5 << 0.5 << 0.5 << 0.5 << 1.0 << 2.0 << 3.0 << std::uint32_t(7);
  file.Text("folder/a picture.jpg") << std::uint64_t(2);
  file << 10.5 << 20.25 << std::uint64_t(5) << 30.0 << 40.0 << std::uint64_t(UINT64_MAX);
  file << std::uint32_t(4) << 1.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << std::uint32_t(1);
  file.Text("b.jpg") << std::uint64_t(0);
  return file.Content;
}

std::string BinaryPoints()
{
  BinaryFile file;
  file << std::uint64_t(1) << std::uint64_t(5) << 0.25 << -1e-3 << 4.0 << std::uint8_t(255)
       << std::uint8_t(0) << std::uint8_t(128) << 0.75 << std::uint64_t(1) << std::uint32_t(3)
       << std::uint32_t(0);
  return file.Content;
}

void WriteTextModel(const TemporaryFolder& folder)
{
  folder.Write("cameras.txt", textCameras);
  folder.Write("images.txt", textImages);
  folder.Write("points3D.txt", textPoints);
}

void WriteBinaryModel(const TemporaryFolder& folder)
{
  folder.Write("cameras.bin", BinaryCameras());
  folder.Write("images.bin", BinaryImages());
  folder.Write("points3D.bin", BinaryPoints());
}

void ExpectTheModel(const SparseModel& model)
{
  ASSERT_EQ(model.cameras.size(), 2u);
  EXPECT_EQ(model.cameras[0].id, 1u);
  EXPECT_EQ(model.cameras[0].model, LensModel::Pinhole);
  EXPECT_EQ(model.cameras[0].width, 640u);
  EXPECT_EQ(model.cameras[0].height, 480u);
  EXPECT_EQ(model.cameras[1].parameters, (std::vector<double>{ 700, 400, 300, -0.1 }));
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.images[0].id, 3u);
  EXPECT_EQ(model.images[0].name, "folder/a picture.jpg");
  EXPECT_EQ(model.images[0].camera, 7u);
  EXPECT_EQ(model.images[0].translation, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(model.images[0].observations.size(), 2u);
  EXPECT_EQ(model.images[0].observations[0].pixel, Eigen::Vector2d(10.5, 20.25));
  EXPECT_EQ(model.images[0].observations[0].point, 5u);
  EXPECT_EQ(model.images[0].observations[1].point, SparseObservation::noPoint);
  EXPECT_TRUE(model.images[1].observations.empty());
  ASSERT_EQ(model.points.size(), 1u);
  EXPECT_EQ(model.points[0].id, 5u);
  EXPECT_EQ(model.points[0].position, Eigen::Vector3d(0.25, -1e-3, 4));
  EXPECT_EQ(model.points[0].color, (std::array<std::uint8_t, 3>{ 255, 0, 128 }));
  EXPECT_EQ(model.points[0].error, 0.75);
  ASSERT_EQ(model.points[0].track.size(), 1u);
  EXPECT_EQ(model.points[0].track[0].image, 3u);
  EXPECT_EQ(model.points[0].track[0].observation, 0u);
}

// The message of the error, which must name all the words.
void ExpectColmapError(const TemporaryFolder& folder, const std::vector<std::string>& words)
{
  ExpectError([&] { ReadColmapModel(folder.Path()); }, words);
}

// A text model of which one file is replaced must be refused with these words.
void ExpectTextError(
  const std::string& file, const std::string& content, const std::vector<std::string>& words)
{
  TemporaryFolder folder;
  WriteTextModel(folder);
  folder.Write(file, content);
  ExpectColmapError(folder, words);
}

}

TEST(ColmapModel, Text)
{
  TemporaryFolder folder;
  WriteTextModel(folder);
  ExpectTheModel(ReadColmapModel(folder.Path()));
}

TEST(ColmapModel, Binary)
{
  TemporaryFolder folder;
  WriteBinaryModel(folder);
  ExpectTheModel(ReadColmapModel(folder.Path()));
}

TEST(ColmapModel, BinaryIsPreferred)
{
  TemporaryFolder folder;
  WriteBinaryModel(folder);
  folder.Write("cameras.txt", "broken");
  folder.Write("images.txt", "broken");
  ExpectTheModel(ReadColmapModel(folder.Path()));
}

TEST(ColmapModel, LineEndsOfWindowsAndTabs)
{
  TemporaryFolder folder;
  WriteTextModel(folder);
  folder.Write("cameras.txt",
    "1\tPINHOLE 640 480 500 510 320.5 240.25\r\n7 SIMPLE_RADIAL 800 600 700  400 300 -0.1\r\n");
  ExpectTheModel(ReadColmapModel(folder.Path()));
}

TEST(ColmapModel, PointsMayBeAbsent)
{
  TemporaryFolder folder;
  folder.Write("cameras.txt", textCameras);
  folder.Write("images.txt", textImages);
  const SparseModel model = ReadColmapModel(folder.Path());
  EXPECT_EQ(model.images.size(), 2u);
  EXPECT_TRUE(model.points.empty());
}

TEST(ColmapModel, LastImageWithoutItsLineOfObservations)
{
  TemporaryFolder folder;
  folder.Write("cameras.txt", textCameras);
  folder.Write("images.txt", "1 1 0 0 0 0 0 0 1 a.jpg");
  EXPECT_EQ(ReadColmapModel(folder.Path()).images.size(), 1u);
}

TEST(ColmapModel, RotationAndTranslation)
{
  TemporaryFolder folder;
  WriteTextModel(folder);
  const CalibratedImage image = CalibratedImages(ReadColmapModel(folder.Path())).at(0);
  // The quaternion (1, 1, 1, 1) / 2 takes x to y, y to z and z to x.
  EXPECT_TRUE(image.camera.FromWorld({ 10, 20, 30 })
                .isApprox(Eigen::Vector3d(30 + 1, 10 + 2, 20 + 3), 1e-14));
}

TEST(ColmapModel, SimplePinhole)
{
  const CalibratedImage image = ImageWithCamera("SIMPLE_PINHOLE 640 480 500 320 240");
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  EXPECT_EQ(image.camera.K, K);
  EXPECT_TRUE(image.camera.R.isApprox(Eigen::Matrix3d::Identity(), 1e-15));
  EXPECT_EQ(image.camera.width, 640);
  EXPECT_EQ(image.camera.height, 480);
  EXPECT_TRUE(image.distortion.empty());
}

TEST(ColmapModel, Pinhole)
{
  const CalibratedImage image = ImageWithCamera("PINHOLE 640 480 500 510 320 240");
  EXPECT_EQ(image.camera.K(0, 0), 500);
  EXPECT_EQ(image.camera.K(1, 1), 510);
  EXPECT_EQ(image.camera.K(0, 2), 320);
  EXPECT_EQ(image.camera.K(1, 2), 240);
  EXPECT_TRUE(image.distortion.empty());
}

TEST(ColmapModel, DistortionInTheOrderOfOpenCV)
{
  using List = std::vector<double>;
  EXPECT_EQ(ImageWithCamera("SIMPLE_RADIAL 9 9 5 3 4 1").distortion, (List{ 1, 0, 0, 0 }));
  EXPECT_EQ(ImageWithCamera("RADIAL 9 9 5 3 4 1 2").distortion, (List{ 1, 2, 0, 0 }));
  EXPECT_EQ(ImageWithCamera("OPENCV 9 9 5 6 3 4 1 2 3 4").distortion, (List{ 1, 2, 3, 4 }));
  const CalibratedImage full = ImageWithCamera("FULL_OPENCV 9 9 5 6 3 4 1 2 3 4 5 6 7 8");
  EXPECT_EQ(full.distortion, (List{ 1, 2, 3, 4, 5, 6, 7, 8 }));
  EXPECT_EQ(full.camera.K(1, 1), 6);
  EXPECT_EQ(ImageWithCamera("RADIAL 9 9 5 3 4 1 2").camera.K(1, 2), 4);
}

TEST(ColmapModel, NoSuchFolder)
{
  EXPECT_THROW(ReadColmapModel("/no/such/folder"), Error);
}

TEST(ColmapModel, EmptyFolder)
{
  TemporaryFolder folder;
  ExpectColmapError(folder, { folder.Path(), "cameras.txt" });
}

TEST(ColmapModel, MissingImages)
{
  TemporaryFolder folder;
  folder.Write("cameras.txt", textCameras);
  ExpectColmapError(folder, { "images.txt" });
}

TEST(ColmapModel, UnsupportedModel)
{
  ExpectTextError("cameras.txt", "\n1 EUCM 640 480 1 1 1 1 1\n",
    { "cameras.txt, line 2", "EUCM", "not supported", "THIN_PRISM_FISHEYE" });
  ExpectTextError(
    "cameras.txt", "1 EQUIRECTANGULAR 640 480\n", { "line 1", "equirectangular", "panorama_sfm" });
  TemporaryFolder folder;
  WriteBinaryModel(folder);
  std::string cameras = BinaryCameras();
  cameras[12] = 11;
  folder.Write("cameras.bin", cameras);
  ExpectColmapError(folder, { "cameras.bin", "number 11", "not supported" });
}

TEST(ColmapModel, MalformedCameras)
{
  const std::string file = "cameras.txt";
  ExpectTextError(file, "1 PINHOLE 640 480 500 510 320.5\n", { "line 1", "ends before" });
  ExpectTextError(
    file, "1 PINHOLE 640 480 500 510 320.5 1 2\n", { "line 1", "unexpected text", "'2'" });
  ExpectTextError(file, "one PINHOLE 640 480 500 510 320 240\n", { "line 1", "'one'" });
  ExpectTextError(file, "-1 PINHOLE 640 480 500 510 320 240\n", { "line 1", "'-1'" });
  ExpectTextError(file, "1 PINHOLE 0 480 500 510 320 240\n", { "line 1", "width" });
  ExpectTextError(file, "1 PINHOLE 99999999999 480 5 5 3 2\n", { "line 1", "width" });
  ExpectTextError(file, "1 PINHOLE 640 480 nan 510 320 240\n", { "line 1", "not finite" });
  ExpectTextError(file, "1 PINHOLE 640 480 -500 510 320 240\n", { "line 1", "focal length" });
  ExpectTextError(file, "1 PINHOLE 640 480 500 0 320 240\n", { "line 1", "focal length" });
  ExpectTextError(file, textCameras + textCameras, { "line 5", "the id 1" });
}

TEST(ColmapModel, MalformedImages)
{
  const std::string file = "images.txt";
  ExpectTextError(file, "1 1 0 0 0 0 0 0 9 a.jpg\n\n", { "images.txt, line 1", "a.jpg", "9" });
  ExpectTextError(file, "1 1 0 0 0 0 0 0 1\n\n", { "line 1", "name" });
  ExpectTextError(file, "1 1 0 0 0 0 0 zero 1 a.jpg\n\n", { "line 1", "'zero'" });
  ExpectTextError(file, "1 0 0 0 0 0 0 0 1 a.jpg\n\n", { "line 1", "pose" });
  ExpectTextError(file, "1 1 0 0 0 0 inf 0 1 a.jpg\n\n", { "line 1", "pose" });
  ExpectTextError(file, "1 1 0 0 0 0 0 0 1 a.jpg\n1 2\n", { "line 2", "ends before" });
  ExpectTextError(file, "1 1 0 0 0 0 0 0 1 a.jpg\n1 2 3.5\n", { "line 2", "'3.5'" });
  ExpectTextError(file, "1 1 0 0 0 0 0 0 1 a\n\n1 1 0 0 0 0 0 0 1 b\n\n", { "line 3", "the id 1" });
  ExpectTextError(file, "1 1 0 0 0 0 0 0 1 a\n\n2 1 0 0 0 0 0 0 1 a\n\n", { "two images", "a" });
}

TEST(ColmapModel, MalformedPoints)
{
  const std::string file = "points3D.txt";
  ExpectTextError(file, "5 0 0 0 256 0 0 1\n", { "points3D.txt, line 1", "'256'" });
  ExpectTextError(file, "5 0 0 nan 255 0 0 1\n", { "line 1", "not finite" });
  ExpectTextError(file, "5 0 0 0 255 0 0 1 3\n", { "line 1", "ends before" });
  ExpectTextError(file, textPoints + textPoints, { "line 2", "the id 5" });
}

// Cut anywhere, each binary file is an error that names it.
TEST(ColmapModel, TruncatedBinary)
{
  const std::pair<const char*, std::string> files[] = { { "cameras.bin", BinaryCameras() },
    { "images.bin", BinaryImages() }, { "points3D.bin", BinaryPoints() } };
  for (const auto& [name, content] : files)
  {
    TemporaryFolder folder;
    WriteBinaryModel(folder);
    for (std::size_t length = 0; length < content.size(); ++length)
    {
      folder.Write(name, content.substr(0, length));
      ExpectColmapError(folder, { name, "truncated" });
    }
  }
}

TEST(ColmapModel, MoreThanTheCountsSay)
{
  TemporaryFolder folder;
  WriteBinaryModel(folder);
  folder.Write("images.bin", BinaryImages() + "x");
  ExpectColmapError(folder, { "images.bin", "more" });
}

// Any byte may be any value: that may go unnoticed or be an error, but must not crash or allocate
// what a wrong count asks for.
TEST(ColmapModel, DamagedBinary)
{
  const std::pair<const char*, std::string> files[] = { { "cameras.bin", BinaryCameras() },
    { "images.bin", BinaryImages() }, { "points3D.bin", BinaryPoints() } };
  for (const auto& [name, content] : files)
  {
    TemporaryFolder folder;
    WriteBinaryModel(folder);
    for (std::size_t i = 0; i < content.size(); ++i)
    {
      std::string damaged = content;
      damaged[i] = static_cast<char>(0xff);
      folder.Write(name, damaged);
      try
      {
        CalibratedImages(ReadColmapModel(folder.Path()));
      }
      catch (const Error& error)
      {
        EXPECT_NE(std::string(error.what()).find(folder.Path()), std::string::npos) << error.what();
      }
    }
  }
}

TEST(ColmapModel, WrittenAndReadAgain)
{
  for (const LensModel lens : everyLensModel)
  {
    SparseModel model = MakeSyntheticModel(5, 100, lens);
    model.images[1].name = "a name with blanks.jpg";
    model.images[2].observations.clear();
    for (const ColmapFormat format : { ColmapFormat::Text, ColmapFormat::Binary })
    {
      TemporaryFolder folder;
      WriteColmapModel(model, folder.Path("new"), format);
      ExpectSameModel(model, ReadColmapModel(folder.Path("new")));
    }
  }
}

TEST(ColmapModel, EmptyModelWrittenAndReadAgain)
{
  TemporaryFolder folder;
  WriteColmapModel({}, folder.Path(), ColmapFormat::Binary);
  EXPECT_TRUE(ReadColmapModel(folder.Path()).images.empty());
}

// Else the old binary model would be read.
TEST(ColmapModel, WritingRemovesTheOtherFormat)
{
  TemporaryFolder folder;
  WriteBinaryModel(folder);
  const SparseModel model = MakeSyntheticModel(3, 10);
  WriteColmapModel(model, folder.Path(), ColmapFormat::Text);
  ExpectSameModel(model, ReadColmapModel(folder.Path()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.Path()), {}), 3);
}

TEST(ColmapModel, WrittenToAFolderThatIsNotThere)
{
  EXPECT_THROW(WriteColmapModel({}, "/no/such/folder", ColmapFormat::Text), Error);
}

// COLMAP's own program reads what is written, and what it writes is the same model.
TEST(ColmapModel, ColmapReadsIt)
{
  if (std::system("colmap help >/dev/null 2>&1") != 0)
  {
    GTEST_SKIP() << "colmap is not installed";
  }
  const SparseModel model = MakeSyntheticModel(4, 50, LensModel::Radial);
  for (const ColmapFormat format : { ColmapFormat::Text, ColmapFormat::Binary })
  {
    TemporaryFolder folder;
    WriteColmapModel(model, folder.Path("ours"), format);
    std::filesystem::create_directories(folder.Path("theirs"));
    const std::string command = "colmap model_converter --input_path " + folder.Path("ours") +
      " --output_path " + folder.Path("theirs") + " --output_type BIN >" + folder.Path("log") +
      " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    SparseModel theirs = ReadColmapModel(folder.Path("theirs"));
    for (SparseImage& image : theirs.images)
    {
      // COLMAP normalizes quaternions again, which may change the last bit.
      const auto ours = std::find_if(model.images.begin(), model.images.end(),
        [&](const SparseImage& other) { return other.id == image.id; });
      ASSERT_NE(ours, model.images.end());
      for (std::size_t k = 0; k < 4; ++k)
      {
        EXPECT_NEAR(image.rotation[k], ours->rotation[k], 1e-15);
      }
      image.rotation = ours->rotation;
    }
    ExpectSameModel(model, theirs);
  }
}
