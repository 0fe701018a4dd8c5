// SPDX-License-Identifier: BSD-3-Clause
// The files of other programs, written from a known model after their specifications, hold the same cameras as
// COLMAP's.
#include "ModelFiles/ReadSparseModel.h"

#include "Common/Error.h"
#include "SparseModel/ColmapModel.h"
#include "Support/ModelTexts.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace freespace;

namespace
{

constexpr double exact = 1e-9;

// The same cameras, in any order.
void ExpectSameCameras(const SparseModel& expected, const SparseModel& model)
{
  ASSERT_EQ(model.images.size(), expected.images.size());
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  for (const CalibratedImage& image : CalibratedImages(expected))
  {
    const auto same = std::find_if(images.begin(), images.end(),
      [&](const CalibratedImage& other) { return other.file == image.file; });
    ASSERT_NE(same, images.end()) << image.file;
    EXPECT_LT((same->camera.K - image.camera.K).norm(), exact);
    EXPECT_LT((same->camera.R - image.camera.R).norm(), exact);
    EXPECT_LT((same->camera.t - image.camera.t).norm(), exact);
    EXPECT_EQ(same->camera.width, image.camera.width);
    EXPECT_EQ(same->camera.height, image.camera.height);
    const auto padded = [](std::vector<double> distortion)
    {
      distortion.resize(8, 0.0);
      return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(distortion.data(), 8));
    };
    EXPECT_EQ(same->lens, image.lens);
    EXPECT_LT((padded(same->distortion) - padded(image.distortion)).norm(), exact);
  }
}

// And the same points, each seen by the same images in the same pixels.
void ExpectSamePoints(const SparseModel& expected, const SparseModel& model)
{
  ASSERT_EQ(model.points.size(), expected.points.size());
  const SparseTracks expectedTracks(expected), tracks(model);
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    EXPECT_LT((model.points[i].position - expected.points[i].position).norm(), exact);
    ASSERT_EQ(tracks.ofPoint[i].size(), expectedTracks.ofPoint[i].size());
    for (std::size_t k = 0; k < tracks.ofPoint[i].size(); ++k)
    {
      const SparseLink& link = tracks.ofPoint[i][k];
      const SparseLink& other = expectedTracks.ofPoint[i][k];
      EXPECT_EQ(model.images[link.image].name, expected.images[other.image].name);
      EXPECT_LT((model.images[link.image].observations[link.observation].pixel -
                  expected.images[other.image].observations[other.observation].pixel)
                  .norm(),
        exact);
    }
  }
}

// The model as COLMAP's files hold it.
SparseModel FromColmap(const SparseModel& model)
{
  TemporaryFolder folder;
  WriteColmapModel(model, folder.Path("colmap"), ColmapFormat::Text);
  return ReadSparseModel(folder.Path("colmap"));
}

SparseModel ReadText(const std::string& name, const std::string& text)
{
  TemporaryFolder folder;
  return ReadSparseModel(folder.Write(name, text));
}

void ExpectFormatError(
  const std::string& name, const std::string& text, const std::vector<std::string>& words)
{
  SCOPED_TRACE(name);
  ExpectError([&] { ReadText(name, text); }, words);
}

std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

}

TEST(ModelFormats, TransformsHaveTheCamerasOfColmap)
{
  for (const LensModel lens : { LensModel::Pinhole, LensModel::OpenCV, LensModel::OpenCVFisheye })
  {
    const SparseModel model = MakeSyntheticModel(5, 0, lens);
    const SparseModel expected = FromColmap(model);
    for (const bool isCommon : { true, false })
    {
      ExpectSameCameras(expected, ReadText("transforms.json", TransformsText(model, isCommon)));
    }
  }
}

TEST(ModelFormats, TransformsOfInstantNgp)
{
  // No size but that of the field of view, a name without an extension, and a fisheye by its flag.
  const std::string text =
    R"({"camera_angle_x": 1.5707963267948966, "w": 800, "h": 600, "is_fisheye": true,
    "k1": 0.25, "aabb_scale": 4, "frames": [{"file_path": "./train/r_0", "sharpness": 9,
    "transform_matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}]})";
  const SparseModel model = ReadText("transforms_train.json", text);
  ASSERT_EQ(model.images.size(), 1u);
  const CalibratedImage image = CalibratedImages(model)[0];
  EXPECT_EQ(image.file, "train/r_0.png");
  EXPECT_NEAR(image.camera.K(0, 0), 400, exact); // tan 45 degrees is half the width
  EXPECT_NEAR(image.camera.K(1, 1), 400, exact);
  EXPECT_EQ(image.camera.K(0, 2), 400);
  EXPECT_EQ(image.camera.K(1, 2), 300);
  EXPECT_EQ(image.lens, LensKind::Fisheye);
  EXPECT_EQ(image.distortion, (std::vector<double>{ 0.25, 0, 0, 0 }));
  // y up and looking along -z.
  EXPECT_LT(
    (image.camera.FromWorld({ 1.5, 2.25, -1 }) - Eigen::Vector3d(0.5, -0.25, 4)).norm(), exact);
}

TEST(ModelFormats, TransformsWhoseWorldWasTurned)
{
  // nerfstudio multiplies the pose of each frame from the left.
  const auto read = [](const std::string& applied, const std::string& pose)
  {
    const SparseModel model = ReadText("transforms.json",
      R"({"camera_angle_x": 1.5, "w": 800, "h": 600, )" + applied +
        R"("frames": [{"file_path": "a.png", "transform_matrix": )" + pose + "}]}");
    return CalibratedImages(model)[0].camera;
  };
  const Camera expected = read("", "[[0.6,-0.8,0,1],[0.8,0.6,0,2],[0,0,1,3],[0,0,0,1]]");
  const Camera turned = read(R"("applied_transform": [[1,0,0,0],[0,0,1,0],[0,-1,0,0.5]], )",
    "[[0.6,-0.8,0,1],[0,0,1,3],[-0.8,-0.6,0,-1.5],[0,0,0,1]]");
  EXPECT_LT((turned.Center() - expected.Center()).norm(), exact);
  EXPECT_LT((turned.FromWorld({ 4, -2, 7 }) - expected.FromWorld({ 4, -2, 7 })).norm(), exact);
}

TEST(ModelFormats, TransformsThatAreRefused)
{
  const std::string good = TransformsText(MakeSyntheticModel(2, 0, LensModel::OpenCV), true);
  const char* name = "transforms.json";
  ExpectFormatError(name, Replaced(good, "\"OPENCV\"", "\"EQUIRECTANGULAR\""),
    { name, "'camera_model'", "equirectangular", "split360Images" });
  ExpectFormatError(name, Replaced(good, "\"OPENCV\"", "\"EUCM\""), { "EUCM", "not supported" });
  ExpectFormatError(name, Replaced(good, "\"w\":", "\"v\":"), { name, "'w' is missing" });
  ExpectFormatError(name, Replaced(good, "\"fl_x\":", "\"x\":"), { "'fl_x' is missing" });
  ExpectFormatError(
    name, Replaced(good, "[0,0,0,1]", "[0,0,1]"), { "'frames'[0], 'transform_matrix'", "16" });
  ExpectFormatError(
    name, Replaced(good, "image1.jpg", "image0.jpg"), { "two images are called image0.jpg" });
  ExpectFormatError(name,
    Replaced(
      good, "\"frames\"", R"("applied_transform": [[2,0,0,0],[0,2,0,0],[0,0,2,0]], "frames")"),
    { name, "'applied_transform'", "no rotation" });
  ExpectFormatError(name, "{\"frames\": [", { name, "not valid JSON" });
}

TEST(ModelFormats, OpenMvgHasTheModelOfColmap)
{
  for (const LensModel lens : { LensModel::SimplePinhole, LensModel::SimpleRadial,
         LensModel::Radial, LensModel::FullOpenCV, LensModel::OpenCVFisheye })
  {
    SparseModel model = MakeSyntheticModel(4, 30, lens);
    MakeExpressible(model);
    const SparseModel expected = FromColmap(model);
    const SparseModel read = ReadText("sfm_data.json", OpenMvgText(model));
    ExpectSameCameras(expected, read);
    ExpectSamePoints(expected, read);
  }
}

TEST(ModelFormats, OpenMvgThatIsRefused)
{
  SparseModel model = MakeSyntheticModel(2, 3, LensModel::Radial);
  const std::string good = OpenMvgText(model);
  const char* name = "sfm_data.json";
  ExpectFormatError(
    name, Replaced(good, "pinhole_radial_k3", "spherical"), { name, "equirectangular" });
  ExpectFormatError(name, Replaced(good, "pinhole_radial_k3", "egg"), { "egg", "not supported" });
  ExpectFormatError(
    name, Replaced(good, "\"polymorphic_name\":", "\"name\":"), { "'intrinsics'[0]", "class" });
  ExpectFormatError(
    name, Replaced(good, "\"center\":", "\"centre\":"), { "'extrinsics'[0]", "'center'" });
}

TEST(ModelFormats, AliceVisionHasTheModelOfColmap)
{
  for (const LensModel lens : { LensModel::Pinhole, LensModel::SimpleRadial, LensModel::FullOpenCV,
         LensModel::OpenCVFisheye, LensModel::FieldOfView })
  {
    SparseModel model = MakeSyntheticModel(4, 30, lens);
    MakeExpressible(model);
    const SparseModel expected = FromColmap(model);
    for (const std::array<int, 3>& version : { std::array<int, 3>{ 1, 0, 0 }, { 1, 2, 0 },
           { 1, 2, 1 }, { 1, 2, 3 }, { 1, 2, 6 }, { 1, 2, 7 } })
    {
      if (version[1] == 0 && FocalLengths(lens) == 2 && lens == LensModel::Pinhole)
      {
        continue; // it had one focal length
      }
      const SparseModel read = ReadText("cameras.sfm", AliceVisionText(model, version));
      ExpectSameCameras(expected, read);
      ExpectSamePoints(expected, read);
      const SparseModel ofRig = ReadText("cameras.sfm", AliceVisionText(model, version, true));
      ExpectSameCameras(expected, ofRig);
      ExpectSamePoints(expected, ofRig);
    }
  }
}

TEST(ModelFormats, AliceVisionThatIsRefused)
{
  const std::string good =
    AliceVisionText(MakeSyntheticModel(2, 3, LensModel::SimpleRadial), { 1, 2, 6 });
  ExpectFormatError(
    "a.sfm", Replaced(good, "\"radial3\"", "\"equirectangular\""), { "a.sfm", "equirectangular" });
  ExpectFormatError(
    "a.sfm", Replaced(good, "\"radial3\"", "\"3deanamorphic4\""), { "3deanamorphic4" });
  ExpectFormatError("a.sfm",
    Replaced(good, "\"viewId\"", "\"isPoseIndependant\": false, \"viewId\""), { "no such rig" });
  ExpectFormatError("a.sfm", Replaced(good, "\"28", "\"x28"), { "'intrinsics'[0]", "number" });
}

TEST(ModelFormats, MetashapeHasTheCamerasOfColmap)
{
  for (const LensModel lens :
    { LensModel::Pinhole, LensModel::OpenCV, LensModel::FullOpenCV, LensModel::ThinPrismFisheye })
  {
    SparseModel model = MakeSyntheticModel(4, 0, lens);
    MakeExpressible(model);
    ExpectSameCameras(FromColmap(model), ReadText("cameras.xml", MetashapeText(model)));
  }
}

// Labels without an extension, as Metashape has them, are images that exist.
TEST(ModelFormats, MetashapesPhotographs)
{
  const std::string text =
    Replaced(MetashapeText(MakeSyntheticModel(2, 0)), "\"image0.jpg\"", "\"image0\"");
  TemporaryFolder folder;
  folder.Write("images/image0.JPG", "");
  const SparseModel model = ReadSparseModel(folder.Write("cameras.xml", text));
  EXPECT_EQ(model.images[0].name, "images/image0.JPG");
  EXPECT_EQ(model.images[1].name, "image1.jpg");
}

TEST(ModelFormats, MetashapeThatIsRefused)
{
  const std::string good = MetashapeText(MakeSyntheticModel(2, 0, LensModel::OpenCV));
  const char* name = "cameras.xml";
  ExpectFormatError(name, Replaced(good, "type=\"frame\"", "type=\"spherical\""),
    { name, "line 4", "equirectangular" });
  ExpectFormatError(name, Replaced(good, "<k1>", "<b2>3</b2><k1>"), { "b2" });
  ExpectFormatError(
    name, Replaced(good, "sensor_id=\"0\"", "sensor_id=\"9\""), { "image0.jpg", "sensor" });
  ExpectFormatError(
    name, Replaced(good, "component_id=\"0\"", "component_id=\"1\""), { "2 components" });
  ExpectFormatError(name, good.substr(0, good.size() / 2), { name, "not a valid" });
  ExpectFormatError(name, "<!DOCTYPE a [<!ENTITY b \"c\">]>" + good.substr(good.find("<document")),
    { "document type" });
  std::string deep = "<document>";
  for (int i = 0; i < 100000; ++i)
  {
    deep += "<a>";
  }
  ExpectFormatError(name, deep, { "nested too deep" });
}

TEST(ModelFormats, MiddleburyHasTheCamerasOfColmap)
{
  for (const LensModel lens : { LensModel::Pinhole, LensModel::SimplePinhole })
  {
    SparseModel model = MakeSyntheticModel(5, 0, lens);
    model.cameras[0].width = 811; // twice the principal point, since the image files are missing
    model.cameras[0].height = lens == LensModel::Pinhole ? 581 : 600;
    model.cameras[0].width = lens == LensModel::Pinhole ? 811 : 800;
    ExpectSameCameras(FromColmap(model), ReadText("temple_par.txt", MiddleburyText(model)));
  }
}

TEST(ModelFormats, MiddleburyThatIsRefused)
{
  const std::string good = MiddleburyText(MakeSyntheticModel(2, 0));
  ExpectFormatError("a_par.txt", good.substr(0, good.size() / 2), { "a_par.txt", "ends before" });
  ExpectFormatError(
    "a_par.txt", "1\na.png 500 3 320 0 500 240 0 0 1 1 0 0 0 1 0 0 0 1 0 0 0\n", { "skew" });
  ExpectFormatError(
    "a_par.txt", "1\na.png 500 0 320 0 500 240 0 0 1 2 0 0 0 1 0 0 0 1 0 0 0\n", { "rotation" });
}

TEST(ModelFormats, KindsThatAreNotReadAreNamed)
{
  const std::pair<const char*, const char*> kinds[] = { { "a.psx", "Metashape project" },
    { "a.rcproj", "RealityCapture" }, { "a.abc", "aliceVision_convertSfMFormat" },
    { "scene.mvs", "OpenMVS" }, { "poses_bounds.npy", "LLFF" }, { "database.db", "database" },
    { "a.ply", "no cameras" }, { "a.mg", "Meshroom" } };
  for (const auto& [file, word] : kinds)
  {
    ExpectFormatError(file, "x", { file, word });
  }
  ExpectFormatError(
    "reconstruction.json", "[{\"cameras\": {}, \"shots\": {}}]", { "OpenSfM", "export_colmap" });
  ExpectFormatError("a.xyz", "x", { "a.xyz", "neither" });
  ExpectFormatError("some.json", "{\"a\": 1}", { "some.json", "neither" });
}

TEST(ModelFormats, FoundInTheirFolders)
{
  const SparseModel model = MakeSyntheticModel(3, 20, LensModel::Radial);
  const std::pair<const char*, ModelKind> kinds[] = { { "transforms.json", ModelKind::Transforms },
    { "sfm_data.json", ModelKind::OpenMvg }, { "a.sfm", ModelKind::AliceVision },
    { "cameras.xml", ModelKind::Metashape }, { "temple_par.txt", ModelKind::Middlebury },
    { "x.nvm", ModelKind::Nvm }, { "bundle.out", ModelKind::Bundler } };
  for (const auto& [name, kind] : kinds)
  {
    TemporaryFolder folder;
    const std::string text = kind == ModelKind::Transforms ? TransformsText(model, true)
      : kind == ModelKind::OpenMvg                         ? OpenMvgText(model)
      : kind == ModelKind::Metashape                       ? MetashapeText(model)
                                                           : "";
    const std::string file = folder.Write(name, text);
    const ModelSource source = FindModel(folder.Path());
    EXPECT_EQ(source.kind, kind) << name;
    EXPECT_EQ(std::filesystem::path(source.path), std::filesystem::path(file)) << name;
    EXPECT_EQ(FindModel(file).kind, kind) << name;
    EXPECT_TRUE(FindModel(file).told.empty());
    // A scene.json says what the folder is, and two files are none.
    folder.Write("scene.json", "{}");
    EXPECT_EQ(FindModel(folder.Path()).kind, ModelKind::None) << name;
  }
  TemporaryFolder folder;
  folder.Write("a.nvm", "");
  folder.Write("b.nvm", "");
  EXPECT_EQ(FindModel(folder.Path()).kind, ModelKind::None);
}

TEST(ModelFormats, FilesOfColmapMeanTheirFolder)
{
  TemporaryFolder folder;
  WriteColmapModel(MakeSyntheticModel(3, 20), folder.Path("m"), ColmapFormat::Binary);
  for (const char* file : { "m/cameras.bin", "m/images.bin", "m/points3D.bin" })
  {
    EXPECT_EQ(ReadSparseModel(folder.Path(file)).images.size(), 3u);
  }
}
