// SPDX-License-Identifier: BSD-3-Clause
#include "ViewDependent/PhotographLayers.h"

#include "Execution/SMPParallelFor.h"
#include "Mesh/Distance/SurfaceSamples.h"
#include "ViewDependent/OpenGLFunctions.h"

#include <vtkOpenGLState.h>

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// Colours with their mipmaps, disparity and confidence.
constexpr double BytesPerTexel = 4.0 * 4.0 / 3.0 + 8.0;

}

void PhotographLayers::RemovePhotographs()
{
  this->DeleteTextures();
  this->Photographs.clear();
  this->Maps.clear();
}

void PhotographLayers::SetPhotographs(const std::vector<Photograph>& photographs, int longestSide)
{
  this->RemovePhotographs();
  for (const Photograph& photograph : photographs)
  {
    this->Photographs.push_back(Reduced(photograph, longestSide));
    this->LayerWidth = std::max(this->LayerWidth, this->Photographs.back().camera.width);
    this->LayerHeight = std::max(this->LayerHeight, this->Photographs.back().camera.height);
  }
}

void PhotographLayers::MakeMaps(const TriangleMesh& surface, const VisibilityOptions& options)
{
  this->Samples.clear();
  for (const SurfaceSample& sample : SampleSurface(surface, 500))
  {
    this->Samples.push_back(sample.point);
  }
  this->Maps.assign(this->Photographs.size(), VisibilityMap());
  SMPParallelFor(this->Maps.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Maps[i] = MakeVisibilityMap(surface, this->Photographs[i].camera, options);
      }
    });
  this->DeleteTextures();
}

void PhotographLayers::UpdateLayers(vtkOpenGLState* state, const Eigen::Vector3d& novelCenter,
  std::size_t most, double memory, int colorUnit, int visibilityUnit)
{
  GLint limit = 1;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limit);
  const double layerBytes = BytesPerTexel * this->LayerWidth * this->LayerHeight;
  const double affordable = std::max(1.0, std::floor(memory / layerBytes));
  const std::size_t count = std::min({ this->Photographs.size(), most, std::size_t(limit),
    static_cast<std::size_t>(std::min(affordable, 1e6)) });
  if (this->Colors.Exists() && this->Layers.size() != count)
  {
    this->DeleteTextures();
  }
  const std::vector<int> wanted =
    BestViews(this->Photographs, this->Maps, this->Samples, novelCenter, count);
  const bool fresh = !this->Colors.Exists();
  if (wanted == this->Layers && !fresh)
  {
    return;
  }
  const std::vector<int> before = this->Layers;
  this->Layers = wanted;
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (fresh)
  {
    const int layerCount = static_cast<int>(count);
    this->Visibility.Create(
      state, this->LayerWidth, this->LayerHeight, layerCount, GL_RG32F, GL_RG, GL_FLOAT, false);
    this->Colors.Create(state, this->LayerWidth, this->LayerHeight, layerCount, GL_RGBA8, GL_RGBA,
      GL_UNSIGNED_BYTE, true);
  }
  for (std::size_t layer = 0; layer < count; ++layer)
  {
    if (fresh || before[layer] != wanted[layer])
    {
      this->UploadLayer(state, static_cast<int>(layer), colorUnit, visibilityUnit);
    }
  }
  this->Colors.Bind(state, colorUnit);
  glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

void PhotographLayers::UploadLayer(
  vtkOpenGLState* state, int layer, int colorUnit, int visibilityUnit)
{
  const VisibilityMap& map = this->Maps[this->Layers[layer]];
  Photograph photograph = this->Photographs[this->Layers[layer]];
  FillMasked(map, photograph);
  const std::size_t width = this->LayerWidth;
  std::vector<unsigned char> rgba(4 * width * this->LayerHeight, 0);
  std::vector<float> seen(2 * width * this->LayerHeight, 0.0f);
  for (int row = 0; row < photograph.camera.height; ++row)
  {
    const std::size_t from = std::size_t(row) * photograph.camera.width;
    for (int column = 0; column < photograph.camera.width; ++column)
    {
      const std::size_t to = row * width + column;
      std::copy_n(&photograph.rgb[3 * (from + column)], 3, &rgba[4 * to]);
      seen[2 * to] = map.disparity.values[from + column];
      seen[2 * to + 1] = map.confidence[from + column];
    }
  }
  this->Colors.Bind(state, colorUnit);
  this->Colors.Upload(layer, rgba.data());
  this->Visibility.Bind(state, visibilityUnit);
  this->Visibility.Upload(layer, seen.data());
}

void PhotographLayers::DeleteTextures()
{
  this->Colors.Delete();
  this->Visibility.Delete();
  this->Layers.clear();
}

ViewOrder PhotographLayers::OrderLayers(const Eigen::Vector3d& novelCenter) const
{
  std::vector<Eigen::Vector3d> centers;
  for (int layer = 0; layer < this->NumberOfLayers(); ++layer)
  {
    centers.push_back(this->PhotographOf(layer).camera.Center());
  }
  return OrderViews(centers, this->Samples, novelCenter);
}

void PhotographLayers::Bind(vtkOpenGLState* state, int colorUnit, int visibilityUnit)
{
  this->Visibility.Bind(state, visibilityUnit);
  this->Colors.Bind(state, colorUnit);
}

}
