// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Picture_h
#define freespace_Picture_h

#include <array>
#include <string>

class vtkPolyData;

namespace freespace
{

class Session;

/// Throws Error unless a picture can be written under that name.
void CheckPictureName(const std::string& fileName);

/// The viewpoint of a picture if no camera is given, as in vtkSurfacePicture.
struct PictureLook
{
  std::array<int, 2> size = { 1280, 960 }; ///< pixels
  bool useViewpoint = true;                ///< of the surface, where it has one
  double azimuth = -123;                   ///< degrees
  double elevation = 33;
  std::array<double, 3> up = { 0, 0, 1 };
  double zoom = 1;
  std::array<double, 3> background = { 1, 1, 1 };
  bool edges = false;
  std::string colorArray; ///< empty: none
};

/// Writes a picture of a surface as PNG, from the camera of a view's block or, where that is nullptr, as
/// `look` tells. Throws Error when that fails.
void WritePicture(Session& session, vtkPolyData* surface, vtkPolyData* view,
  const PictureLook& look, const std::string& fileName);

}

#endif
