// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PlanesScene_h
#define freespace_PlanesScene_h

#include "Refinement/CameraRefinement.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace freespace
{

/// Two slanted planes of coloured squares, photographed by a cross of cameras, on disk.
class PlanesScene
{
public:
  PlanesScene()
    : Cameras(CrossOfCameras())
  {
    const Layers planes = TwoPlanes(1.1, [](double x, double) { return x > 0; });
    const char* names[5] = { "c.png", "l.png", "r.png", "u.png", "d.png" };
    std::filesystem::create_directories(this->Folder.Path("images"));
    SparseCamera lens;
    lens.id = 1;
    const Camera& first = this->Cameras[0];
    lens.width = first.width;
    lens.height = first.height;
    lens.parameters = { first.K(0, 0), first.K(1, 1), first.K(0, 2), first.K(1, 2) };
    this->Exact.cameras.push_back(lens);
    for (std::uint32_t i = 0; i < 5; ++i)
    {
      cv::imwrite(this->Folder.Path("images/" + std::string(names[i])),
        Render(planes, this->Cameras[i], nullptr, 12));
      SparseImage image;
      image.id = i + 1;
      image.name = names[i];
      image.camera = 1;
      const Eigen::Quaterniond q(this->Cameras[i].R);
      image.rotation = { q.w(), q.x(), q.y(), q.z() };
      image.translation = this->Cameras[i].t;
      this->Exact.images.push_back(image);
    }
    this->Scene.file = this->Folder.Path("scene.json");
    this->Scene.images = "images";
  }

  CameraRefinement Refine(
    const SparseModel& model, const ParallelFor& parallelFor = SerialFor) const
  {
    EdgeStore edges(this->Scene, EdgeTokenOptions());
    return RefineCameras(this->Scene, model, edges, MatcherOptions(), CameraRefinementOptions(),
      parallelFor, Progress());
  }

  /// The model with its cameras turned, so that the images move by about so many pixels.
  SparseModel Perturbed(double pixels) const
  {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, pixels / 400);
    SparseModel model = this->Exact;
    for (SparseImage& image : model.images)
    {
      const Eigen::Vector3d turn(normal(random), normal(random), normal(random));
      const Eigen::Quaterniond r(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      const auto& [w, x, y, z] = image.rotation;
      const Eigen::Quaterniond q = r * Eigen::Quaterniond(w, x, y, z);
      image.rotation = { q.w(), q.x(), q.y(), q.z() };
      image.translation = r * image.translation;
    }
    return model;
  }

  TemporaryFolder Folder;
  std::vector<Camera> Cameras;
  freespace::Scene Scene;
  SparseModel Exact;
};

}

#endif
