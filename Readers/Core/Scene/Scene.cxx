// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "Common/Error.h"
#include "Files/AtomicOutput.h"
#include "Files/NameEncoding.h"
#include "Files/PathChecks.h"
#include "Images/ImageFile.h"
#include "ModelFiles/ForeignModel.h"
#include "ModelFiles/ReadSparseModel.h"
#include "Scene/ClusterFaults.h"
#include "Scene/ScaledImages.h"
#include "Text/JsonNode.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <unordered_set>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

std::array<std::string, 3> ReadTriplet(const JsonNode& node, const std::string& reference)
{
  const std::vector<JsonNode> elements = node.Elements();
  if (elements.size() != 3)
  {
    node.Fail("a triplet has three images");
  }
  std::array<std::string, 3> triplet = { elements[0].Text(), elements[1].Text(),
    elements[2].Text() };
  const std::string fault = TripletFault(triplet, reference);
  if (!fault.empty())
  {
    node.Fail(fault);
  }
  return triplet;
}

Cluster ReadCluster(const JsonNode& node)
{
  node.ExpectObject({ "name", "reference", "triplets" });
  Cluster cluster;
  cluster.name = node.At("name").Text();
  const fs::path path(cluster.name);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
  {
    node.Fail("the name of a cluster, " + cluster.name + ", is a path that leaves its folder");
  }
  cluster.reference = node.At("reference").Text();
  for (const JsonNode& triplet : node.At("triplets").Elements())
  {
    cluster.triplets.push_back(ReadTriplet(triplet, cluster.reference));
  }
  return cluster;
}

std::vector<Cluster> ReadClusters(const JsonNode& node)
{
  std::vector<Cluster> clusters;
  std::set<std::string> names;
  for (const JsonNode& element : node.Elements())
  {
    clusters.push_back(ReadCluster(element));
    const std::string fault = ClusterFault(clusters.back(), names);
    if (!fault.empty())
    {
      element.Fail(fault);
    }
  }
  if (clusters.empty())
  {
    node.Fail("the list is empty; leave 'clusters' out to have them proposed");
  }
  return clusters;
}

void ReadBoardSize(const JsonNode& node, Board& board)
{
  const std::vector<JsonNode> size = node.Elements();
  if (size.size() != 2)
  {
    node.Fail("expected two numbers, of columns and rows");
  }
  board.columns = size[0].Integer();
  board.rows = size[1].Integer();
}

Board ReadBoard(const JsonNode& node)
{
  node.ExpectObject({ "type", "squares", "corners", "square_m", "marker_m", "dictionary" });
  Board board;
  const std::string type = node.At("type").Text();
  board.square = node.At("square_m").Number();
  if (type == "charuco")
  {
    node.ExpectObject({ "type", "squares", "square_m", "marker_m", "dictionary" });
    board.kind = Board::Kind::Charuco;
    ReadBoardSize(node.At("squares"), board);
    board.marker = node.At("marker_m").Number();
    board.dictionary = node.At("dictionary").Text();
  }
  else if (type == "chessboard")
  {
    node.ExpectObject({ "type", "corners", "square_m" });
    board.kind = Board::Kind::Chessboard;
    ReadBoardSize(node.At("corners"), board);
  }
  else
  {
    node.At("type").Fail("a board is a 'charuco' or a 'chessboard', not a '" + type + "'");
  }
  try
  {
    board.Check();
  }
  catch (const Error& error)
  {
    node.Fail(error.what());
  }
  return board;
}

std::string Resolve(const std::string& sceneFile, const std::string& folder)
{
  return (fs::path(sceneFile).parent_path() / folder).string();
}

// Converts a folder relative to one file to a folder relative to another.
std::string Rebase(const std::string& from, const std::string& folder, const std::string& to)
{
  if (folder.empty() || fs::path(folder).is_absolute())
  {
    return folder;
  }
  std::error_code tooLong;
  const fs::path target = fs::absolute(Resolve(from, folder));
  const fs::path rebased = fs::proximate(target, fs::absolute(fs::path(to)).parent_path(), tooLong);
  return (tooLong ? target : rebased).string();
}

// An ordered object keeps the documented order of keys.
using OrderedJson = nlohmann::ordered_json;

OrderedJson JsonFromCluster(const Cluster& cluster)
{
  OrderedJson json;
  json["name"] = Utf8FromName(cluster.name);
  json["reference"] = Utf8FromName(cluster.reference);
  for (const std::array<std::string, 3>& triplet : cluster.triplets)
  {
    json["triplets"].push_back(
      { Utf8FromName(triplet[0]), Utf8FromName(triplet[1]), Utf8FromName(triplet[2]) });
  }
  return json;
}

OrderedJson JsonFromBoard(const Board& board)
{
  const bool charuco = board.kind == Board::Kind::Charuco;
  OrderedJson json;
  json["type"] = charuco ? "charuco" : "chessboard";
  json[charuco ? "squares" : "corners"] = { board.columns, board.rows };
  json["square_m"] = board.square;
  if (charuco)
  {
    json["marker_m"] = board.marker;
    json["dictionary"] = board.dictionary;
  }
  return json;
}

// The folder `images` beside a model or above it, or else the folder of the model.
std::string ImagesBeside(const fs::path& model)
{
  fs::path above = model / "";
  for (int level = 0; level < 4 && above.has_parent_path(); ++level)
  {
    above = above.parent_path();
    if (IsFolder(above / "images"))
    {
      return (above / "images").string();
    }
  }
  return model.string();
}

// A scene of a model. Files of other programs tell where their images are; they may have moved.
Scene SceneOfModel(const std::string& path, const ModelSource& source)
{
  const fs::path model = fs::absolute(source.path).lexically_normal();
  Scene scene;
  scene.file = path;
  scene.model = model.string();
  if (source.kind == ModelKind::Colmap)
  {
    scene.images = ImagesBeside(model);
    return scene;
  }
  const SparseModel read = ReadSparseModel(source.path);
  const fs::path told = fs::absolute(read.folder.empty() ? "." : read.folder).lexically_normal();
  const bool areThere = std::any_of(read.images.begin(), read.images.end(),
    [&](const SparseImage& image) { return IsThere(told / image.name); });
  scene.images = areThere ? told.string() : ImagesBeside(model.parent_path());
  return scene;
}

}

void Board::Check() const
{
  const int least = this->kind == Kind::Charuco ? 2 : 3;
  if (this->columns < least || this->rows < least || this->columns > 1000 || this->rows > 1000)
  {
    throw Error("A board has from " + std::to_string(least) + " to 1000 columns and rows.");
  }
  if (!(this->square > 0) || !std::isfinite(this->square))
  {
    throw Error("The squares of a board must have a positive size.");
  }
  if (this->kind == Kind::Charuco && !(this->marker > 0 && this->marker < this->square))
  {
    throw Error("The markers of a ChArUco board must be smaller than its squares.");
  }
}

std::vector<std::string> OtherImages(const Cluster& cluster)
{
  std::vector<std::string> others;
  for (const auto& triplet : cluster.triplets)
  {
    for (const std::string& file : { triplet[0], triplet[2] })
    {
      if (std::find(others.begin(), others.end(), file) == others.end())
      {
        others.push_back(file);
      }
    }
  }
  return others;
}

std::string Scene::ImagesFolder() const
{
  return Resolve(this->file, this->images);
}

std::string Scene::ModelFolder() const
{
  return Resolve(this->file, this->model);
}

std::string Scene::MaskPath(const std::string& image) const
{
  return this->masks.empty()
    ? ""
    : (fs::path(Resolve(this->file, this->masks)) / (image + ".png")).string();
}

std::string Scene::ImagePath(const std::string& image) const
{
  return (fs::path(this->ImagesFolder()) / image).string();
}

cv::Mat Scene::Pixels(const CalibratedImage& image) const
{
  if (!this->pixels)
  {
    return LoadImage(this->ImagePath(image.file), image.camera.width, image.camera.height);
  }
  const auto found = this->pixels->find(image.file);
  if (found == this->pixels->end())
  {
    throw Error("There is no image " + image.file + ".");
  }
  return found->second;
}

Scene ReadScene(const std::string& path)
{
  std::string file = path;
  if (IsFolder(path))
  {
    file = (fs::path(path) / "scene.json").string();
    file = IsThere(file) ? file : path;
  }
  if (const ModelSource source = FindModel(file); source.kind != ModelKind::None)
  {
    return SceneOfModel(path, source);
  }
  if (const std::string foreign = DescribeForeignModel(file); !foreign.empty())
  {
    throw Error("Cannot read " + file + ": " + foreign + ".");
  }
  if (IsFolder(file))
  {
    throw Error("Cannot read " + file +
      ": it is a folder, neither a scene.json nor with a camera model (cameras and images, .bin or "
      ".txt).");
  }
  const JsonDocument document(file);
  const JsonNode root = document.Root();
  root.ExpectObject({ "images", "model", "masks", "clusters", "board" });
  Scene scene;
  scene.file = file;
  scene.images = root.At("images").Text();
  scene.model = root.At("model").Text();
  scene.masks = root.Has("masks") ? root.At("masks").Text() : "";
  if (root.Has("clusters"))
  {
    scene.clusters = ReadClusters(root.At("clusters"));
  }
  if (root.Has("board"))
  {
    scene.board = ReadBoard(root.At("board"));
  }
  return scene;
}

void WriteScene(const Scene& scene, const std::string& file)
{
  OrderedJson json;
  json["images"] = Utf8FromName(Rebase(scene.file, scene.images, file));
  json["model"] = Utf8FromName(Rebase(scene.file, scene.model, file));
  if (!scene.masks.empty())
  {
    json["masks"] = Utf8FromName(Rebase(scene.file, scene.masks, file));
  }
  for (const Cluster& cluster : scene.clusters)
  {
    json["clusters"].push_back(JsonFromCluster(cluster));
  }
  if (scene.board)
  {
    json["board"] = JsonFromBoard(*scene.board);
  }
  AtomicOutput target(file);
  std::ofstream stream(target.Path());
  stream << json.dump(1) << "\n";
  stream.close();
  if (!stream)
  {
    throw Error("Cannot write " + file + ": the disk is full or failed.");
  }
  target.Commit();
}

SparseModel ReadSceneModel(const Scene& scene, std::string* scaled)
{
  SparseModel model = ReadSparseModel(scene.ModelFolder());
  const std::string told = ScaleToPhotographs(scene, model);
  if (scaled)
  {
    *scaled = told;
  }
  std::unordered_set<std::string> known;
  for (const SparseImage& image : model.images)
  {
    known.insert(image.name);
  }
  for (const Cluster& cluster : scene.clusters)
  {
    for (const std::array<std::string, 3>& triplet : cluster.triplets)
    {
      for (const std::string& image : triplet)
      {
        if (!known.count(image))
        {
          throw Error("Cannot read " + scene.file + ": the cluster " + cluster.name +
            " names an image that " + scene.ModelFolder() + " does not have, " + image + ".");
        }
      }
    }
  }
  return model;
}

std::vector<CalibratedImage> ReadCameras(const std::string& path)
{
  return IsSparseModel(path) ? CalibratedImages(ReadSparseModel(path))
                             : ReadSceneImages(ReadScene(path));
}

std::vector<CalibratedImage> ReadSceneImages(const Scene& scene)
{
  return CalibratedImages(ReadSceneModel(scene));
}

std::vector<CalibratedImage> PresentImages(const Scene& scene, std::vector<CalibratedImage> images)
{
  images.erase(
    std::remove_if(images.begin(), images.end(),
      [&scene](const CalibratedImage& image) { return !IsThere(scene.ImagePath(image.file)); }),
    images.end());
  return images;
}

}
