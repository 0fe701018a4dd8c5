// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PhotographLayers_h
#define freespace_PhotographLayers_h

#include "Texture/Photograph.h"
#include "Mesh/TriangleMesh.h"
#include "Texture/VisibilityMap.h"
#include "ViewDependent/LayeredTexture.h"
#include "ViewSelection/ViewSelection.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// The images of a surface and what each of them sees of it, and the texture arrays that hold the best
/// of them for a viewpoint.
class PhotographLayers
{
public:
  /// Keeps the images, reduced where a side is longer than `longestSide` pixels. The functions that
  /// change the images or the maps delete the textures: their context must be current.
  void SetPhotographs(const std::vector<Photograph>& photographs, int longestSide);
  void RemovePhotographs();

  /// Computes a visibility map for each image.
  void MakeMaps(const TriangleMesh& surface, const VisibilityOptions& options);

  /// Whether each image has its map.
  bool HasMaps() const { return this->Maps.size() == this->Photographs.size(); }

  /// Selects the views for a novel centre of projection, at most `most`, in at most `memory` bytes, and
  /// uploads those that are not in the textures yet.
  void UpdateLayers(vtkOpenGLState* state, const Eigen::Vector3d& novelCenter, std::size_t most,
    double memory, int colorUnit, int visibilityUnit);

  /// The context must be current.
  void DeleteTextures();

  bool IsEmpty() const { return this->Photographs.empty(); }
  int NumberOfLayers() const { return static_cast<int>(this->Layers.size()); }
  const Photograph& PhotographOf(int layer) const { return this->Photographs[this->Layers[layer]]; }
  const VisibilityMap& MapOf(int layer) const { return this->Maps[this->Layers[layer]]; }
  int Width() const { return this->LayerWidth; }   ///< of a layer, texels
  int Height() const { return this->LayerHeight; } ///< of a layer, texels

  /// See OrderViews.
  ViewOrder OrderLayers(const Eigen::Vector3d& novelCenter) const;

  void Bind(vtkOpenGLState* state, int colorUnit, int visibilityUnit);

private:
  void UploadLayer(vtkOpenGLState* state, int layer, int colorUnit, int visibilityUnit);

  std::vector<Photograph> Photographs; // reduced to the limits
  std::vector<VisibilityMap> Maps;     // one for each image
  std::vector<Eigen::Vector3d> Samples;
  std::vector<int> Layers; // the image that each layer of the textures holds
  LayeredTexture Colors;
  LayeredTexture Visibility;
  int LayerWidth = 0;
  int LayerHeight = 0;
};

}

#endif
