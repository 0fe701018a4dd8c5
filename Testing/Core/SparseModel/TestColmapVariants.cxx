// SPDX-License-Identifier: BSD-3-Clause
// Models as other versions of COLMAP and people write them.
#include "SparseModel/ColmapModel.h"

#include "Support/ExpectSameModel.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ColmapImage.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace freespace;

namespace
{

const std::string cameras = "1 PINHOLE 640 480 500 510 320.5 240.25\n"
                            "7 SIMPLE_RADIAL 800 600 700 400 300 -0.1\n";
const std::string images = "3 0.5 0.5 0.5 0.5 1 2 3 7 folder/a picture.jpg\n"
                           "10.5 20.25 5 30 40 -1\n"
                           "4 1 0 0 0 0 0 0 1 b.jpg\n"
                           "\n";
const std::string points = "5 0.25 -1e-3 4 255 0 128 0.75 3 0\n";

SparseModel ReadWith(const TemporaryFolder& folder, const std::string& before = "")
{
  folder.Write("cameras.txt", before + cameras);
  folder.Write("images.txt", before + images);
  folder.Write("points3D.txt", before + points);
  return ReadColmapModel(folder.Path());
}

}

// People who write a model by hand leave out the empty lines between images, and editors take them away.
TEST(ColmapVariants, ImagesWithoutLinesOfObservations)
{
  TemporaryFolder folder;
  folder.Write("cameras.txt", cameras);
  const std::string lines[] = { "3 0.5 0.5 0.5 0.5 1 2 3 7 a picture.jpg\n",
    "4 1 0 0 0 0 0 0 1 b.jpg\n", "5 1 0 0 0 0 0 9 1 12 c.jpg\n" };
  for (const std::string between : { "", "# a comment\n", "\n", "\n\n# a comment\n" })
  {
    std::string images = lines[0];
    images.append(between).append(lines[1]).append(between).append(lines[2]);
    folder.Write("images.txt", images);
    const SparseModel model = ReadColmapModel(folder.Path());
    ASSERT_EQ(model.images.size(), 3u) << "'" << between << "'";
    EXPECT_EQ(model.images[0].name, "a picture.jpg");
    EXPECT_EQ(model.images[1].id, 4u);
    EXPECT_EQ(model.images[2].translation, Eigen::Vector3d(0, 0, 9));
    EXPECT_TRUE(model.images[0].observations.empty());
  }
  folder.Write("images.txt", lines[0] + "10 20 5 30 40 -1 1 2 -1 3 4 5\n" + lines[1] + lines[2]);
  const SparseModel model = ReadColmapModel(folder.Path());
  ASSERT_EQ(model.images.size(), 3u);
  EXPECT_EQ(model.images[0].observations.size(), 4u);
}

TEST(ColmapVariants, ByteOrderMarks)
{
  const TemporaryFolder plain, marked;
  const SparseModel model = ReadWith(plain);
  EXPECT_EQ(model.images.size(), 2u);
  ExpectSameModel(model, ReadWith(marked, "\xEF\xBB\xBF"));
}

// As COLMAP 3.12 writes it: the poses are still in images.txt.
TEST(ColmapVariants, RigsAndFramesBesideAModel)
{
  const TemporaryFolder plain, folder;
  folder.Write("rigs.txt",
    "# Rig calib list with one line of data per calib:\n1 2 CAMERA 1\nCAMERA 7 1 1 0 0 0 0.1 0 "
    "0\n");
  folder.Write("frames.txt", "# Frame list\n1 1 1 0 0 0 0 0 0 2 CAMERA 7 3 CAMERA 1 4\n");
  const SparseModel model = ReadWith(folder);
  ExpectSameModel(model, ReadWith(plain));
  // A model that is written in its place must not be taken for one of these rigs.
  for (const ColmapFormat format : { ColmapFormat::Text, ColmapFormat::Binary })
  {
    folder.Write("rigs.bin", "x");
    folder.Write("frames.txt", "x");
    WriteColmapModel(model, folder.Path(), format);
    for (const char* file : { "rigs.txt", "rigs.bin", "frames.txt", "frames.bin" })
    {
      EXPECT_FALSE(std::filesystem::exists(folder.Path(file))) << file;
    }
  }
}

TEST(ColmapVariants, FisheyeLenses)
{
  using List = std::vector<double>;
  const CalibratedImage simple = ImageWithCamera("SIMPLE_RADIAL_FISHEYE 9 9 5 3 4 1");
  EXPECT_EQ(simple.lens, LensKind::Fisheye);
  EXPECT_EQ(simple.distortion, (List{ 1, 0, 0, 0 }));
  EXPECT_EQ(ImageWithCamera("RADIAL_FISHEYE 9 9 5 3 4 1 2").distortion, (List{ 1, 2, 0, 0 }));
  const CalibratedImage openCV = ImageWithCamera("OPENCV_FISHEYE 9 9 5 6 3 4 1 2 3 4");
  EXPECT_EQ(openCV.lens, LensKind::Fisheye);
  EXPECT_EQ(openCV.distortion, (List{ 1, 2, 3, 4 }));
  const CalibratedImage prism = ImageWithCamera("THIN_PRISM_FISHEYE 9 9 5 6 3 4 1 2 3 4 5 6 7 8");
  EXPECT_EQ(prism.lens, LensKind::ThinPrismFisheye);
  EXPECT_EQ(prism.distortion, (List{ 1, 2, 3, 4, 5, 6, 7, 8 }));
  const CalibratedImage fov = ImageWithCamera("FOV 9 9 5 6 3 4 0.5");
  EXPECT_EQ(fov.lens, LensKind::FieldOfView);
  EXPECT_EQ(fov.distortion, (List{ 0.5 }));
}
