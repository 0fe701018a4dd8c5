// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageNeighborhoods_h
#define freespace_ImageNeighborhoods_h

#include "Scene/CenterIndex.h"
#include "Scene/ClusterProposalOptions.h"
#include "SparseModel/SparseModel.h"

#include <optional>
#include <unordered_map>
#include <vector>

namespace freespace
{

inline constexpr double degree = 3.14159265358979323846 / 180; ///< in radians

/// An image that can confirm what another one, the reference, sees.
struct Neighbor
{
  int image = 0;
  double angle = 0;                                    ///< to the reference at the scene, radians
  double overlap = 0;                                  ///< fraction of the reference's image
  double distance = 0;                                 ///< of the centres
  Eigen::Vector2d direction = Eigen::Vector2d::Zero(); ///< in the reference's image, of length 1
  double quality = 0;                                  ///< in (0, 1]
};

/// What each image of a model sees, as a sample of points, and which neighbours edge stereo can match it
/// with.
///
/// The samples are the model's own points. An image without points is assumed to look at where its
/// neighbours' optical axes pass its own or, with parallel axes, at the distance at which the nearest image
/// is at the preferred angle; its sample is a grid over its image at that depth.
class ImageNeighborhoods
{
public:
  ImageNeighborhoods(const SparseModel& model, const ClusterProposalOptions& options);

  std::size_t Size() const { return this->Images.size(); }
  const Camera& CameraOf(std::size_t i) const { return this->Images[i].camera; }

  /// Of the scene along the optical axis.
  double Depth(std::size_t i) const { return this->Depths[i]; }

  /// The suitable images near the ideal positions of neighbours, the best first; a bounded
  /// number.
  std::vector<Neighbor> NeighborsOf(std::size_t i) const;

  /// Of the points that image i sees, the fraction that lies in the image of j. 0 if, by the
  /// model, they have no point in common, as when something occludes the view.
  double Overlap(std::size_t i, std::size_t j) const;

  /// Between the rays from the middle of what image i sees to both centres, radians.
  double AngleBetween(std::size_t i, std::size_t j) const;

  /// The images within this angle of image i, seen from the scene, in radians.
  std::vector<int> Within(std::size_t i, double angle) const;

private:
  std::vector<Eigen::Vector3d> PointsBefore(
    const SparseModel& model, const SparseTracks& tracks, std::size_t image);
  double SceneDepth(std::size_t i) const;
  std::vector<Eigen::Vector3d> Screen(std::size_t i) const;
  Eigen::Vector3d Target(std::size_t i) const;
  std::vector<int> Candidates(std::size_t i) const;
  std::optional<Neighbor> Judge(std::size_t i, int j) const;
  double AngleQuality(double angle) const;

  ClusterProposalOptions Options;
  std::vector<CalibratedImage> Images;
  CenterIndex Index;
  std::vector<std::unordered_map<int, int>> Shared; // per image: how many of its samples others see
  std::vector<std::vector<Eigen::Vector3d>> Samples;
  std::vector<double> Depths;
};

}

#endif
