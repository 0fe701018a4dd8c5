// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PatchAligner_h
#define freespace_PatchAligner_h

#include "Common/Camera.h"
#include "Patches/PatchOptions.h"
#include "Patches/WindowWarp.h"

#include <opencv2/core.hpp>

#include <array>
#include <vector>

namespace freespace
{

/// A plane in space, as the reference image sees it around a pixel: its disparity (1 / depth) is linear
/// in the pixel.
struct PatchPlane
{
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double disparity = 0;                            ///< at the pixel
  Eigen::Vector2d slope = Eigen::Vector2d::Zero(); ///< of the disparity, per pixel

  double At(const Eigen::Vector2d& other) const
  {
    return this->disparity + this->slope.dot(other - this->pixel);
  }
};

/// The result of an alignment.
struct AlignedPatch
{
  bool isTextured = false; ///< the window lies in the image and has contrast in its middle
  bool isGood = false;     ///< it correlates, and its deviation is small enough
  PatchPlane plane;
  double deviation = 0;   ///< standard deviation of the disparity at the pixel
  double correlation = 0; ///< mean over the partners that correlate well; at most 1
};

/// Aligns small planes to the images of a cluster. The plane through a window of the reference image carries its
/// grey levels into the partner images; the three parameters of the plane are those with which they
/// agree best, but for brightness and contrast: least squares matching (Gruen 1985, after Lucas and Kanade,
/// IJCAI 1981), with one plane for all partners (Furukawa and Ponce, PAMI 2010, refine their patches like
/// that).
class PatchAligner
{
public:
  /// A camera and the grey levels of its image.
  struct Image
  {
    Camera camera;
    cv::Mat1f grey;
  };

  /// `scale` is the resolution of the grey levels as a fraction of the cameras'.
  PatchAligner(const Image& reference, const std::vector<Image>& partners, double scale,
    const PatchOptions& options);

  /// Aligns a plane. Not good where the window leaves an image, has no contrast in its middle, moves too
  /// far, or too few partners correlate.
  AlignedPatch Align(const PatchPlane& initial) const;

  /// By how much a change of the disparity moves the plane's pixel in the partner where it moves it most: pixels of
  /// the camera per unit of disparity.
  double Parallax(const PatchPlane& plane) const;

private:
  // Pixel of a partner: H (u, v, 1) + disparity * epipole, in homogeneous coordinates.
  struct Partner
  {
    Eigen::Matrix3d H;
    Eigen::Vector3d epipole;
    cv::Mat1f grey;
  };
  using Values = WindowPixels::Values;
  struct Window;
  struct Equations;

  bool Read(const Eigen::Vector2d& pixel, Window& window) const;
  bool Warp(const Partner& partner, const Window& window, const PatchPlane& plane, Values& values,
    Values& slopes) const;
  void Add(const Window& window, const PatchPlane& plane, const Values& values,
    const Values& slopes, Equations& equations) const;

  cv::Mat1f Reference;
  double FocalLength; // pixels
  std::vector<Partner> Partners;
  double Scale;
  PatchOptions Options;
  WindowPixels Pixels;
};

}

#endif
