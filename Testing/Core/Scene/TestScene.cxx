// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

const std::string cluster =
  R"({ "name": "one", "reference": "c", "triplets": [["l", "c", "r"], ["u", "c", "d"]] })";
const std::string board = R"({ "type": "charuco", "squares": [15, 14], "square_m": 0.03,
  "marker_m": 0.0225, "dictionary": "DICT_5X5_250" })";

std::string WithClusters(const std::string& clusters)
{
  return R"({ "images": "pictures", "model": "sparse", "clusters": )" + clusters + "}";
}

std::string WithBoard(const std::string& text)
{
  return R"({ "images": "pictures", "model": "sparse", "board": )" + text + "}";
}

void ExpectSceneError(const std::string& content, std::vector<std::string> words)
{
  TemporaryFolder folder;
  SCOPED_TRACE(content);
  words.push_back(folder.Path("scene.json"));
  ExpectError([&] { ReadScene(folder.Write("scene.json", content)); }, words);
}

void WriteSceneModel(const TemporaryFolder& folder, const std::vector<std::string>& images)
{
  folder.Write("sparse/cameras.txt", "1 PINHOLE 640 480 500 510 320 240\n");
  std::string text;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    text += std::to_string(i) + " 1 0 0 0 0 0 0 1 " + images[i] + "\n\n";
  }
  folder.Write("sparse/images.txt", text);
}

}

TEST(Scene, Whole)
{
  TemporaryFolder folder;
  const Scene scene = ReadScene(folder.Write("scene.json",
    R"({ "images": "pictures", "model": "../sparse", "clusters": [)" + cluster + R"(], "board": )" +
      board + "}"));
  EXPECT_EQ(scene.ImagesFolder(), folder.Path("pictures"));
  EXPECT_EQ(scene.ModelFolder(), folder.Path("../sparse"));
  EXPECT_EQ(scene.ImagePath("a.jpg"), folder.Path("pictures/a.jpg"));
  ASSERT_EQ(scene.clusters.size(), 1u);
  EXPECT_EQ(scene.clusters[0].name, "one");
  EXPECT_EQ(scene.clusters[0].reference, "c");
  ASSERT_EQ(scene.clusters[0].triplets.size(), 2u);
  EXPECT_EQ(scene.clusters[0].triplets[1], (std::array<std::string, 3>{ "u", "c", "d" }));
  ASSERT_TRUE(scene.board.has_value());
  EXPECT_EQ(scene.board->kind, Board::Kind::Charuco);
  EXPECT_EQ(scene.board->columns, 15);
  EXPECT_EQ(scene.board->rows, 14);
  EXPECT_EQ(scene.board->square, 0.03);
  EXPECT_EQ(scene.board->marker, 0.0225);
  EXPECT_EQ(scene.board->dictionary, "DICT_5X5_250");
}

TEST(Scene, AbsoluteFoldersAndNoClusters)
{
  TemporaryFolder folder;
  const Scene scene =
    ReadScene(folder.Write("scene.json", R"({ "images": "/a/b", "model": "/c" })"));
  EXPECT_EQ(scene.ImagesFolder(), "/a/b");
  EXPECT_EQ(scene.ModelFolder(), "/c");
  EXPECT_TRUE(scene.clusters.empty());
  EXPECT_FALSE(scene.board.has_value());
}

TEST(Scene, Chessboard)
{
  TemporaryFolder folder;
  const Scene scene = ReadScene(folder.Write(
    "scene.json", WithBoard(R"({ "type": "chessboard", "corners": [9, 6], "square_m": 0.025 })")));
  ASSERT_TRUE(scene.board.has_value());
  EXPECT_EQ(scene.board->kind, Board::Kind::Chessboard);
  EXPECT_EQ(scene.board->columns, 9);
  EXPECT_EQ(scene.board->rows, 6);
}

TEST(Scene, NamesThatAreNotUtf8)
{
  TemporaryFolder folder;
  Scene scene;
  scene.file = folder.Path("scene.json");
  scene.images = "caf\xe9";
  scene.model = "m";
  scene.clusters.push_back({ "\xe9", "\xe9.jpg", { { "a", "\xe9.jpg", "b\n" } } });
  WriteScene(scene, scene.file);
  const Scene read = ReadScene(scene.file);
  EXPECT_EQ(read.images, scene.images);
  EXPECT_EQ(read.clusters[0].name, "\xe9");
  EXPECT_EQ(read.clusters[0].triplets, scene.clusters[0].triplets);
}

TEST(Scene, WrittenAndReadAgain)
{
  TemporaryFolder folder;
  const Scene scene = ReadScene(folder.Write("a/scene.json",
    R"({ "images": "pictures", "model": "/absolute", "clusters": [)" + cluster + R"(], "board": )" +
      board + "}"));
  std::filesystem::create_directories(folder.Path("b"));
  WriteScene(scene, folder.Path("b/copy.json"));
  const Scene copy = ReadScene(folder.Path("b/copy.json"));
  EXPECT_EQ(copy.images, "../a/pictures");
  EXPECT_EQ(copy.model, "/absolute");
  ASSERT_EQ(copy.clusters.size(), 1u);
  EXPECT_EQ(copy.clusters[0].name, "one");
  EXPECT_EQ(copy.clusters[0].reference, "c");
  EXPECT_EQ(copy.clusters[0].triplets, scene.clusters[0].triplets);
  ASSERT_TRUE(copy.board.has_value());
  EXPECT_EQ(copy.board->columns, 15);
  EXPECT_EQ(copy.board->square, 0.03);
  EXPECT_EQ(copy.board->dictionary, "DICT_5X5_250");
}

TEST(Scene, WrittenToAFolderThatIsNotThere)
{
  EXPECT_THROW(WriteScene(Scene(), "/no/such/folder/scene.json"), Error);
}

TEST(Scene, MissingFile)
{
  EXPECT_THROW(ReadScene("/no/such/scene.json"), Error);
  EXPECT_THROW(ReadScene("/"), Error);
}

TEST(Scene, BrokenJson)
{
  ExpectSceneError("", { "JSON" });
  ExpectSceneError("{ \"images\": ", { "JSON" });
  ExpectSceneError(
    R"({ "images": "pictures" "model": "sparse" })", { "JSON", "line 1, column 30" });
  ExpectSceneError("{\n  \"images\": \"pictures\",\n}", { "JSON", "line 3, column 1." });
  ExpectSceneError("[]", { "object" });
}

TEST(Scene, TruncatedAnywhere)
{
  const std::string content = WithClusters("[" + cluster + "]");
  for (std::size_t length = 0; length < content.size(); ++length)
  {
    ExpectSceneError(content.substr(0, length), {});
  }
}

TEST(Scene, UnknownKeysAreNamed)
{
  ExpectSceneError(R"({ "images": "a", "model": "b", "colour": 1 })", { "'colour'", "unknown" });
  ExpectSceneError(
    WithClusters(R"([{ "name": "one", "reference": "c", "triplets": [], "weight": 1 }])"),
    { "'weight'", "unknown" });
  ExpectSceneError(WithBoard(R"({ "type": "charuco", "size": 1 })"), { "'size'", "unknown" });
}

TEST(Scene, MissingAndIllTypedKeys)
{
  ExpectSceneError(R"({ "images": "a" })", { "'model'", "missing" });
  ExpectSceneError(R"({ "model": "a" })", { "'images'", "missing" });
  ExpectSceneError(
    R"({ "images": 1, "model": "b" })", { "'images'", "expected a non-empty string" });
  ExpectSceneError(
    R"({ "images": "a", "model": "" })", { "'model'", "expected a non-empty string" });
  ExpectSceneError(WithClusters("1"), { "'clusters'", "expected a JSON array" });
  ExpectSceneError(WithClusters("[1]"), { "'clusters'[0]", "object" });
  ExpectSceneError(WithClusters("[]"), { "'clusters'", "empty" });
}

TEST(Scene, Triplets)
{
  const auto withTriplets = [](const std::string& triplets)
  { return WithClusters(R"([{ "name": "one", "reference": "c", "triplets": )" + triplets + "}]"); };
  ExpectSceneError(
    withTriplets(R"([["c", "l", "r"]])"), { "'triplets'[0]", "reference c", "middle" });
  ExpectSceneError(withTriplets(R"([["l", "c"]])"), { "'triplets'[0]", "three images" });
  ExpectSceneError(withTriplets(R"([["l", "c", "l"]])"), { "'triplets'[0]", "an image twice" });
  ExpectSceneError(withTriplets(R"([["l", "c", "c"]])"), { "'triplets'[0]", "an image twice" });
  ExpectSceneError(withTriplets("[]"), { "one", "no triplet" });
}

TEST(Scene, TwoClustersOfOneName)
{
  ExpectSceneError(WithClusters("[" + cluster + ", " + cluster + "]"), { "called one" });
}

TEST(Scene, ImpossibleBoards)
{
  const auto changed = [](const std::string& from, const std::string& to)
  {
    std::string text = board;
    return WithBoard(text.replace(text.find(from), from.size(), to));
  };
  ExpectSceneError(changed("15, 14", "15"), { "'squares'", "two numbers" });
  ExpectSceneError(changed("15, 14", "15, 1.5"), { "'squares'[1]", "expected an integer" });
  ExpectSceneError(changed("15, 14", "15, -1"), { "'board'", "columns and rows" });
  ExpectSceneError(changed("0.03", "0"), { "'board'", "positive" });
  ExpectSceneError(changed("0.0225", "0.04"), { "'board'", "markers" });
  ExpectSceneError(changed("charuco", "dots"), { "'type'", "dots" });
}

TEST(Scene, ImagesOfTheModel)
{
  TemporaryFolder folder;
  WriteSceneModel(folder, { "l", "c", "r", "u", "d" });
  const Scene scene = ReadScene(folder.Write("scene.json", WithClusters("[" + cluster + "]")));
  const std::vector<CalibratedImage> images = ReadSceneImages(scene);
  ASSERT_EQ(images.size(), 5u);
  EXPECT_EQ(images[3].file, "u");
}

TEST(Scene, ClusterThatNamesAnUnknownImage)
{
  TemporaryFolder folder;
  WriteSceneModel(folder, { "l", "c", "r", "u" });
  const Scene scene = ReadScene(folder.Write("scene.json", WithClusters("[" + cluster + "]")));
  try
  {
    ReadSceneImages(scene);
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("cluster one"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(", d."), std::string::npos) << error.what();
  }
}

TEST(Scene, NamesOfClustersThatLeaveTheirFolder)
{
  TemporaryFolder folder;
  for (const std::string name : { "../../escape", "/escape", "a/../../b" })
  {
    const std::string file = folder.Write("scene.json",
      R"({ "images": "i", "model": "m", "clusters": [{ "name": ")" + name +
        R"(", "reference": "c", "triplets": [["l", "c", "r"]] }] })");
    EXPECT_THROW(ReadScene(file), Error) << name;
  }
}

TEST(Scene, NumberThatIsTooLarge)
{
  TemporaryFolder folder;
  EXPECT_THROW(ReadScene(folder.Write("scene.json",
                 WithBoard(R"({ "type": "chessboard", "corners": [9, 6], "square_m": 1e999 })"))),
    Error);
}
