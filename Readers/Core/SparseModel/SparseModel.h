// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseModel_h
#define freespace_SparseModel_h

#include "Images/CalibratedImage.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace freespace
{

/// The camera models that are supported, under COLMAP's numbers.
enum class LensModel
{
  SimplePinhole = 0,       ///< f cx cy
  Pinhole = 1,             ///< fx fy cx cy
  SimpleRadial = 2,        ///< f cx cy k1
  Radial = 3,              ///< f cx cy k1 k2
  OpenCV = 4,              ///< fx fy cx cy k1 k2 p1 p2
  OpenCVFisheye = 5,       ///< fx fy cx cy k1 k2 k3 k4
  FullOpenCV = 6,          ///< fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6
  FieldOfView = 7,         ///< fx fy cx cy omega
  SimpleRadialFisheye = 8, ///< f cx cy k1
  RadialFisheye = 9,       ///< f cx cy k1 k2
  ThinPrismFisheye = 10    ///< fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1
};

/// COLMAP's name, for instance "SIMPLE_RADIAL".
std::string LensModelName(LensModel model);

/// The model of COLMAP's name or number; nothing for one that is not supported.
std::optional<LensModel> LensModelOf(std::string_view name);
std::optional<LensModel> LensModelOf(int number);

/// Why a camera model, by COLMAP's or another program's name, is not supported, as a clause.
std::string UnsupportedLens(std::string_view name);

/// How many parameters a model has.
std::size_t LensModelParameters(LensModel model);

/// How many of these are focal lengths, 1 or 2. They come first, then the principal point.
std::size_t FocalLengths(LensModel model);

/// A lens and sensor, which images may share.
struct SparseCamera
{
  std::uint32_t id = 0;
  LensModel model = LensModel::Pinhole;
  std::uint64_t width = 0; ///< pixels
  std::uint64_t height = 0;
  std::vector<double> parameters; ///< as listed at LensModel
};

/// Where an image shows a point, or a keypoint that belongs to none.
struct SparseObservation
{
  static constexpr std::uint64_t noPoint = UINT64_MAX;

  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::uint64_t point = noPoint; ///< id of the point
};

struct SparseImage
{
  std::uint32_t id = 0;
  std::string name; ///< file, relative to the folder of the images
  std::uint32_t camera = 0;
  std::array<double, 4> rotation = { 1, 0, 0, 0 }; ///< cam_from_world, quaternion w x y z
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::vector<SparseObservation> observations;
  /// The rotation where it was given as a matrix: the quaternion's differs in the last bits.
  std::optional<Eigen::Matrix3d> matrix;
};

/// One element of a point's track.
struct SparseTrackElement
{
  std::uint32_t image = 0;       ///< id
  std::uint32_t observation = 0; ///< index in the image's observations
};

struct SparsePoint
{
  std::uint64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< world
  std::array<std::uint8_t, 3> color = { 0, 0, 0 };
  double error = -1; ///< mean reprojection error in pixels; -1 when not known
  std::vector<SparseTrackElement> track;
};

/// A structure-from-motion reconstruction as COLMAP keeps it, ids and all, so that what was read
/// can be written again without loss. An observation may name a point that the model does not hold.
struct SparseModel
{
  std::vector<SparseCamera> cameras;
  std::vector<SparseImage> images;
  std::vector<SparsePoint> points;
  /// To which the names of images are relative, where the file that was read tells; else empty.
  std::string folder;
};

/// An observation by indices into the model's lists.
struct SparseLink
{
  int image = 0;
  int observation = 0;
};

/// Who sees what, by indices. It is made from the images' own lists, since models exist whose
/// points have no tracks.
struct SparseTracks
{
  explicit SparseTracks(const SparseModel& model);

  std::vector<std::vector<SparseLink>> ofPoint; ///< per point, in the order of the images
  std::vector<std::vector<int>> pointOf; ///< per image and observation: index of the point or -1
};

/// What makes one of these unusable, as a clause without a period; empty when nothing does.
std::string FaultOf(const SparseCamera& camera);
std::string FaultOf(const SparseImage& image);
std::string FaultOf(const SparsePoint& point);

/// An image with the camera that took it.
CalibratedImage CalibratedImageOf(const SparseImage& image, const SparseCamera& camera);

/// Every image of the model with its pinhole camera and distortion, in the model's order. Throws
/// Error when an image names a camera that the model does not hold.
std::vector<CalibratedImage> CalibratedImages(const SparseModel& model);

}

#endif
