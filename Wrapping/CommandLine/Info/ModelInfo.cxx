// SPDX-License-Identifier: BSD-3-Clause
#include "Info/FileInfo.h"
#include "Info/SummaryInfo.h"
#include "Scene/Scene.h"
#include "ModelFiles/ReadSparseModel.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

Json CamerasInfo(const SparseModel& model)
{
  std::map<std::uint32_t, int> images;
  for (const SparseImage& image : model.images)
  {
    ++images[image.camera];
  }
  Json rows = Json::array();
  for (const SparseCamera& camera : model.cameras)
  {
    rows.push_back({ { "id", camera.id }, { "lens", LensModelName(camera.model) },
      { "width", camera.width }, { "height", camera.height }, { "images", images[camera.id] },
      { "parameters", camera.parameters } });
  }
  return rows;
}

Json ImagesInfo(const SparseModel& model, const std::set<std::string>& references)
{
  const SparseTracks tracks(model);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  Json rows = Json::array();
  for (std::size_t i = 0; i < model.images.size(); ++i)
  {
    std::size_t seen = 0;
    for (int point : tracks.pointOf[i])
    {
      seen += point >= 0 ? 1 : 0;
    }
    const Eigen::Vector3d center = images[i].camera.Center();
    Json row = { { "name", model.images[i].name }, { "camera", model.images[i].camera },
      { "points", seen }, { "centre", { center.x(), center.y(), center.z() } } };
    if (!references.empty())
    {
      row["reference"] = references.count(model.images[i].name) > 0;
    }
    rows.push_back(row);
  }
  return rows;
}

void AddModel(const SparseModel& model, const std::set<std::string>& references, Json& info)
{
  const ModelSummary summary = Summarize(model);
  info["cameras"] = summary.cameras;
  info["images"] = summary.images;
  info["points"] = summary.points;
  info["observations"] = summary.observations;
  if (summary.trackLengths.count > 0)
  {
    info["images_of_a_point"] = SpreadInfo(summary.trackLengths);
    info["angles_in_degrees"] = SpreadInfo(summary.angles);
  }
  if (summary.errors.count > 0)
  {
    info["errors_in_pixels"] = SpreadInfo(summary.errors);
  }
  info["bounds_of_cameras"] = BoundsInfo(summary.centers);
  info["bounds_of_points"] = BoundsInfo(summary.bounds);
  info["of_each_camera"] = CamerasInfo(model);
  info["of_each_image"] = ImagesInfo(model, references);
}

}

Json ModelInfo(const std::string& path)
{
  Json info;
  info["kind"] = "model";
  AddModel(ReadSparseModel(path), {}, info);
  return info;
}

Json SceneInfo(const std::string& path)
{
  const Scene scene = ReadScene(path);
  const SparseModel model = ReadSceneModel(scene);
  std::set<std::string> references;
  Json clusters = Json::array();
  for (const Cluster& cluster : scene.clusters)
  {
    references.insert(cluster.reference);
    clusters.push_back({ { "name", cluster.name }, { "reference", cluster.reference },
      { "triplets", cluster.triplets.size() } });
  }
  std::size_t there = 0;
  for (const SparseImage& image : model.images)
  {
    there += std::filesystem::is_regular_file(scene.ImagePath(image.name)) ? 1 : 0;
  }
  Json info;
  info["kind"] = "scene";
  info["photographs"] = there;
  info["masks"] = !scene.masks.empty();
  info["clusters"] = clusters.size();
  info["references"] = references;
  AddModel(model, references, info);
  info["of_each_cluster"] = clusters;
  return info;
}

}
