// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/MemoryScene.h"

#include "Common/CameraFault.h"
#include "Common/Error.h"
#include "Scene/ClusterFaults.h"
#include "SparseModel/ModelBuilder.h"

#include <map>
#include <set>
#include <utility>

namespace freespace
{

namespace
{

void Check(const MemoryImage& image)
{
  const Camera& camera = image.camera;
  if (const std::string fault = CameraFault(camera); !fault.empty())
  {
    throw Error("The image " + image.name + " " + fault + ".");
  }
  if (camera.K(0, 1) != 0)
  {
    throw Error("The image " + image.name + " has intrinsics with a skew.");
  }
  if (image.pixels.empty() || image.pixels.cols != camera.width ||
    image.pixels.rows != camera.height)
  {
    throw Error("The image " + image.name + " has " + std::to_string(image.pixels.cols) + " x " +
      std::to_string(image.pixels.rows) + " pixels, but its camera has " +
      std::to_string(camera.width) + " x " + std::to_string(camera.height) + ".");
  }
}

SparseCamera LensOf(const Camera& camera)
{
  const Eigen::Matrix3d& K = camera.K;
  SparseCamera lens;
  lens.parameters = { K(0, 0), K(1, 1), K(0, 2), K(1, 2) };
  lens.width = static_cast<std::uint64_t>(camera.width);
  lens.height = static_cast<std::uint64_t>(camera.height);
  return lens;
}

// Among others, whose names it is added to.
void Check(const Cluster& cluster, const std::map<std::string, cv::Mat>& images,
  std::set<std::string>& names)
{
  std::string fault = ClusterFault(cluster, names);
  for (const auto& triplet : cluster.triplets)
  {
    for (const std::string& name : triplet)
    {
      if (!images.count(name))
      {
        throw Error(
          "The cluster " + cluster.name + " names an image that is not there, " + name + ".");
      }
    }
    fault = fault.empty() ? TripletFault(triplet, cluster.reference) : fault;
  }
  if (!fault.empty())
  {
    throw Error("The cluster " + cluster.name + " is not valid: " + fault + ".");
  }
}

}

MemoryScene::MemoryScene(const std::vector<MemoryImage>& images, std::vector<Cluster> clusters)
{
  if (images.empty())
  {
    throw Error("There are no images.");
  }
  ModelBuilder lenses("the images", "");
  std::map<std::string, cv::Mat> pixels;
  for (const MemoryImage& given : images)
  {
    Check(given);
    if (!pixels.emplace(given.name, given.pixels).second)
    {
      throw Error("Two images are called " + given.name + ".");
    }
    SparseImage& image = this->model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(this->model.images.size());
    image.name = given.name;
    image.camera = lenses.AddCamera(LensOf(given.camera));
    const Eigen::Quaterniond q(given.camera.R);
    image.rotation = { q.w(), q.x(), q.y(), q.z() };
    image.matrix = given.camera.R;
    image.translation = given.camera.t;
  }
  this->model.cameras = lenses.Take().cameras;
  std::set<std::string> names;
  for (const Cluster& cluster : clusters)
  {
    Check(cluster, pixels, names);
  }
  this->scene.file = "in memory";
  this->scene.clusters = std::move(clusters);
  this->scene.pixels = std::make_shared<const std::map<std::string, cv::Mat>>(std::move(pixels));
}

}
