// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ModelBuilder_h
#define freespace_ModelBuilder_h

#include "SparseModel/SparseModel.h"

#include <map>
#include <unordered_set>

namespace freespace
{

/// A pose as many programs write it.
struct CenteredPose
{
  Eigen::Matrix3d rotation; ///< from world to camera coordinates
  Eigen::Vector3d center;   ///< of the camera, world
};

/// The simplest camera model that has OpenCV's coefficients of distortion, k1 k2 p1 p2 k3 k4 k5 k6 or
/// fewer; without width and height. Only one focal length where fx is fy.
SparseCamera PerspectiveCamera(
  double fx, double fy, double cx, double cy, std::vector<double> distortion);

/// Builds a model from the content of another program's file: cameras, images, points, in this order. Ids are
/// counted from 1. Throws Error naming the file and the fault where one of them cannot be used.
class ModelBuilder
{
public:
  /// `folder`: the folder that names of images are relative to.
  ModelBuilder(std::string file, const std::string& folder);

  /// Adds a camera and returns its id, that of an identical earlier one if there is one.
  std::uint32_t AddCamera(SparseCamera camera);

  /// An image by the rotation from world to camera, which may be off by rounding, and its centre.
  std::uint32_t AddImage(const std::string& name, std::uint32_t camera,
    const Eigen::Matrix3d& rotation, const Eigen::Vector3d& center);

  /// The next point, to which observations are added.
  void AddPoint(const Eigen::Vector3d& position, const std::array<std::uint8_t, 3>& color);

  /// An observation of the last point in an image.
  void AddObservation(std::uint32_t image, const Eigen::Vector2d& pixel);

  SparseModel Take() { return std::move(this->Model); }

  [[noreturn]] void Fail(const std::string& fault) const;

private:
  void FailOn(const std::string& fault) const;

  std::string File;
  SparseModel Model;
  std::map<std::vector<double>, std::uint32_t> Cameras;
  std::unordered_set<std::string> Names;
};

}

#endif
