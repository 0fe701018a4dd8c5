// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewDependentTextureMapper.h"

#include "CameraForVTK.h"
#include "Common/Error.h"
#include "PhotographBlocks.h"
#include "Execution/SMPParallelFor.h"
#include "ViewDependentTextureShader.h"
#include "Texture/VisibilityMap.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>
#include <vtkVersionMacros.h>
#include <vtkWeakPointer.h>
#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 4)
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

vtkStandardNewMacro(vtkViewDependentTextureMapper);

using freespace::Camera;
using freespace::Photograph;
using freespace::TriangleMesh;
using freespace::VisibilityMap;

namespace
{

// Colours with their mipmaps, disparity and confidence.
constexpr double BytesPerTexel = 4.0 * 4.0 / 3.0 + 8.0;

// A texture array of the context, one layer for each view.
class LayeredTexture
{
public:
  void Create(vtkOpenGLState* state, int width, int height, int layers, unsigned int internalFormat,
    unsigned int format, unsigned int type, bool mipmaps)
  {
    this->Width = width;
    this->Height = height;
    this->Format = format;
    this->Type = type;
    glGenTextures(1, &this->Name);
    this->Bind(state);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(
      GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<int>(internalFormat), width, height, layers, 0,
      format, type, nullptr);
  }

  // The whole layer.
  void Upload(int layer, const void* texels)
  {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, this->Width, this->Height, 1, this->Format,
      this->Type, texels);
  }

  void Bind(vtkOpenGLState* state, int unit = 0)
  {
    state->vtkglActiveTexture(GL_TEXTURE0 + static_cast<unsigned int>(unit));
    glBindTexture(GL_TEXTURE_2D_ARRAY, this->Name);
  }

  void Delete()
  {
    if (this->Name)
    {
      glDeleteTextures(1, &this->Name);
      this->Name = 0;
    }
  }

  bool IsThere() const { return this->Name != 0; }

private:
  unsigned int Name = 0;
  unsigned int Format = 0;
  unsigned int Type = 0;
  int Width = 0;
  int Height = 0;
};

// Where the surface's geometry is drawn: a framebuffer with a multisampled texture and depth.
class GeometryBuffer
{
public:
  void Bind(vtkOpenGLState* state, int width, int height, int samples, int unit)
  {
    if (width != this->Width || height != this->Height || samples != this->AskedSamples)
    {
      this->Delete();
      this->Create(state, width, height, samples, unit);
    }
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Name);
    this->BindTexture(state, unit);
  }

  void BindTexture(vtkOpenGLState* state, int unit)
  {
    state->vtkglActiveTexture(GL_TEXTURE0 + static_cast<unsigned int>(unit));
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, this->Texture);
  }

  void Delete()
  {
    if (this->Name)
    {
      glDeleteFramebuffers(1, &this->Name);
      glDeleteTextures(1, &this->Texture);
      glDeleteRenderbuffers(1, &this->Depth);
      *this = GeometryBuffer();
    }
  }

  bool IsComplete() const { return this->Complete; }
  int GetSamples() const { return this->Samples; }

private:
  void Create(vtkOpenGLState* state, int width, int height, int samples, int unit)
  {
    GLint color = 1;
    GLint depth = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &color);
    glGetIntegerv(GL_MAX_SAMPLES, &depth);
    this->Width = width;
    this->Height = height;
    this->AskedSamples = samples;
    this->Samples = std::max(1, std::min({ samples, color, depth }));
    glGenTextures(1, &this->Texture);
    this->BindTexture(state, unit);
    glTexImage2DMultisample(
      GL_TEXTURE_2D_MULTISAMPLE, this->Samples, GL_RGBA32F, width, height, GL_TRUE);
    glGenRenderbuffers(1, &this->Depth);
    glBindRenderbuffer(GL_RENDERBUFFER, this->Depth);
    glRenderbufferStorageMultisample(
      GL_RENDERBUFFER, this->Samples, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &this->Name);
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Name);
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, this->Texture, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, this->Depth);
    this->Complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }

  unsigned int Name = 0;
  unsigned int Texture = 0;
  unsigned int Depth = 0;
  int Width = 0;
  int Height = 0;
  int AskedSamples = 0;
  int Samples = 0;
  bool Complete = false;
};

// Points of the surface, each for an equal share of its area.
std::vector<Eigen::Vector3d> SampleSurface(const TriangleMesh& mesh, int count)
{
  std::vector<double> areas(mesh.triangles.size());
  double sum = 0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d& corner = mesh.points[a];
    const double area = (mesh.points[b] - corner).cross(mesh.points[c] - corner).norm();
    sum += std::isfinite(area) ? area : 0;
    areas[i] = sum;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i < count && sum > 0; ++i)
  {
    const auto at = std::lower_bound(areas.begin(), areas.end(), sum * (i + 0.5) / count);
    const auto& [a, b, c] = mesh.triangles[at - areas.begin()];
    double s = unit(random);
    double t = unit(random);
    if (s + t > 1)
    {
      s = 1 - s;
      t = 1 - t;
    }
    samples.push_back((1 - s - t) * mesh.points[a] + s * mesh.points[b] + t * mesh.points[c]);
  }
  return samples;
}

// The renderer's camera in the coordinates of the surface.
struct NovelCamera
{
  Eigen::Vector3d center;
  double focal = 1;     // pixels
  Eigen::Matrix3d axes; // rows: right, up, forward
  Eigen::Matrix4d clipFromSurface;
};

Eigen::Matrix4d ToEigen(vtkMatrix4x4* matrix)
{
  return Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix->GetData());
}

NovelCamera FindNovelCamera(vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> worldFromSurface;
  actor->GetMatrix(worldFromSurface);
  const Eigen::Matrix4d viewFromSurface =
    ToEigen(camera->GetModelViewTransformMatrix()) * ToEigen(worldFromSurface);
  const Eigen::Matrix4d surfaceFromView = viewFromSurface.inverse();
  NovelCamera novel;
  novel.clipFromSurface =
    ToEigen(camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1)) *
    ToEigen(worldFromSurface);
  for (int i = 0; i < 3; ++i)
  {
    const double sign = i == 2 ? -1 : 1; // VTK looks along -z
    novel.axes.row(i) = sign * surfaceFromView.block<3, 1>(0, i).normalized();
  }
  double height = renderer->GetSize()[1];
  if (camera->GetParallelProjection())
  {
    const double far = 1e4 * camera->GetDistance();
    novel.center = (surfaceFromView * Eigen::Vector4d(0, 0, far, 1)).head<3>();
    novel.focal = height * far / (2 * camera->GetParallelScale());
  }
  else
  {
    novel.center = surfaceFromView.block<3, 1>(0, 3);
    const double halfAngle = vtkMath::RadiansFromDegrees(camera->GetViewAngle()) / 2;
    novel.focal = height / (2 * std::tan(halfAngle));
  }
  return novel;
}

}

struct vtkViewDependentTextureMapper::InternalState
{
  std::vector<Photograph> photographs; // reduced to the limits
  std::vector<VisibilityMap> maps;     // one for each photograph
  std::vector<Eigen::Vector3d> samples;
  vtkTimeStamp photographsTime;
  vtkTimeStamp mapsTime;
  int longestSide = 0;
  double feather = 0;
  double tolerance = 0;

  std::vector<int> layers; // the photograph that each layer of the textures holds
  LayeredTexture colors;
  LayeredTexture visibility;
  int layerWidth = 0;
  int layerHeight = 0;
  GeometryBuffer geometry;
  std::unique_ptr<vtkOpenGLQuadHelper> coloring;
  int blendedViews = 0; // that the program of coloring was made for
  int geometryUnit = -1;
  int colorUnit = -1;
  int visibilityUnit = -1;
  NovelCamera novel;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); // of positions in the shader

  // The textures belong to the context of this window.
  vtkWeakPointer<vtkOpenGLRenderWindow> window;

  void UseWindow(vtkOpenGLRenderWindow* next)
  {
    if (this->window != next)
    {
      this->DeleteTexturesOfWindow();
      this->window = next;
      next->MakeCurrent();
    }
  }

  void DeleteTexturesOfWindow()
  {
    if (this->window)
    {
      this->window->MakeCurrent();
      this->DeleteAll();
    }
  }

  void DeleteAll()
  {
    this->DeleteTextures();
    this->geometry.Delete();
    if (this->coloring)
    {
      this->coloring->ReleaseGraphicsResources(this->window);
      this->coloring.reset();
    }
  }

  // Their context is current.
  void DeleteTextures()
  {
    this->colors.Delete();
    this->visibility.Delete();
    this->layers.clear();
  }

  void UpdatePhotographs(vtkMultiBlockDataSet* blocks, int longest);
  void UpdateMaps(vtkPolyData* surface, double newFeather, double newTolerance);
  std::vector<int> BestViews(std::size_t count) const;
  void UpdateLayers(vtkOpenGLState* state, std::size_t most, double memory);
  void UploadLayer(vtkOpenGLState* state, int layer);

  struct Order
  {
    std::vector<int> layers;
    std::vector<float> chords; // of these layers
  };
  Order OrderOfLayers() const;
  void MakeProgram(int blended);
  void SetParameters(vtkShaderProgram* program) const;
};

void vtkViewDependentTextureMapper::InternalState::UpdatePhotographs(
  vtkMultiBlockDataSet* blocks, int longest)
{
  if (this->photographsTime > blocks->GetMTime() && this->longestSide == longest)
  {
    return;
  }
  this->DeleteTextures();
  this->photographs.clear();
  this->maps.clear();
  this->photographsTime.Modified(); // also when it fails: the error is told once
  this->longestSide = longest;
  for (const Photograph& photograph : freespace::PhotographsFromBlocks(blocks))
  {
    this->photographs.push_back(freespace::Reduced(photograph, longest));
    this->layerWidth = std::max(this->layerWidth, this->photographs.back().camera.width);
    this->layerHeight = std::max(this->layerHeight, this->photographs.back().camera.height);
  }
}

void vtkViewDependentTextureMapper::InternalState::UpdateMaps(
  vtkPolyData* surface, double newFeather, double newTolerance)
{
  if (this->maps.size() == this->photographs.size() && this->mapsTime > surface->GetMTime() &&
    this->feather == newFeather && this->tolerance == newTolerance)
  {
    return;
  }
  this->feather = newFeather;
  this->tolerance = newTolerance;
  freespace::VisibilityOptions options;
  options.feather = newFeather;
  options.tolerance = newTolerance;
  const TriangleMesh mesh = freespace::MeshFromPolyData(surface);
  this->samples = SampleSurface(mesh, 500);
  this->maps.assign(this->photographs.size(), VisibilityMap());
  freespace::SMPParallelFor(this->maps.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        this->maps[i] = freespace::MakeVisibilityMap(mesh, this->photographs[i].camera, options);
      }
    });
  this->mapsTime.Modified();
  this->DeleteTextures();
}

// Those that have most of the weight in the samples of the surface, in their order.
std::vector<int> vtkViewDependentTextureMapper::InternalState::BestViews(std::size_t count) const
{
  std::vector<int> views(this->photographs.size());
  std::iota(views.begin(), views.end(), 0);
  if (views.size() <= count)
  {
    return views;
  }
  std::vector<double> scores(views.size(), 0.0);
  std::vector<double> weights(views.size());
  for (const Eigen::Vector3d& sample : this->samples)
  {
    const Eigen::Vector3d toNovel = (this->novel.center - sample).normalized();
    double sum = 1e-12;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const Camera& camera = this->photographs[i].camera;
      const double confidence = this->maps[i].At(camera.Project(sample), camera.Depth(sample));
      const double chord = ((camera.Center() - sample).normalized() - toNovel).norm();
      weights[i] = confidence / std::pow(chord + 0.01, 2); // the nearest matter far more
      sum += weights[i];
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      scores[i] += weights[i] / sum;
    }
  }
  std::stable_sort(views.begin(), views.end(), [&](int a, int b) { return scores[a] > scores[b]; });
  views.resize(count);
  std::sort(views.begin(), views.end());
  return views;
}

void vtkViewDependentTextureMapper::InternalState::UploadLayer(vtkOpenGLState* state, int layer)
{
  const VisibilityMap& map = this->maps[this->layers[layer]];
  Photograph photograph = this->photographs[this->layers[layer]];
  freespace::FillMasked(map, photograph);
  const std::size_t width = this->layerWidth;
  std::vector<unsigned char> rgba(4 * width * this->layerHeight, 0);
  std::vector<float> seen(2 * width * this->layerHeight, 0.0f);
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
  this->colors.Bind(state, this->colorUnit);
  this->colors.Upload(layer, rgba.data());
  this->visibility.Bind(state, this->visibilityUnit);
  this->visibility.Upload(layer, seen.data());
}

void vtkViewDependentTextureMapper::InternalState::UpdateLayers(
  vtkOpenGLState* state, std::size_t most, double memory)
{
  GLint limit = 1;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limit);
  const double layerBytes = BytesPerTexel * this->layerWidth * this->layerHeight;
  const double affordable = std::max(1.0, std::floor(memory / layerBytes));
  const std::size_t count = std::min({ this->photographs.size(), most, std::size_t(limit),
    static_cast<std::size_t>(std::min(affordable, 1e6)) });
  if (this->colors.IsThere() && this->layers.size() != count)
  {
    this->DeleteTextures();
  }
  const std::vector<int> wanted = this->BestViews(count);
  const bool fresh = !this->colors.IsThere();
  if (wanted == this->layers && !fresh)
  {
    return;
  }
  const std::vector<int> before = this->layers;
  this->layers = wanted;
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (fresh)
  {
    const int layerCount = static_cast<int>(count);
    this->visibility.Create(
      state, this->layerWidth, this->layerHeight, layerCount, GL_RG32F, GL_RG, GL_FLOAT, false);
    this->colors.Create(state, this->layerWidth, this->layerHeight, layerCount, GL_RGBA8, GL_RGBA,
      GL_UNSIGNED_BYTE, true);
  }
  for (std::size_t layer = 0; layer < count; ++layer)
  {
    if (fresh || before[layer] != wanted[layer])
    {
      this->UploadLayer(state, static_cast<int>(layer));
    }
  }
  this->colors.Bind(state, this->colorUnit);
  glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

// The shader asks the views in this order, and stops where none can be among the best any more.
vtkViewDependentTextureMapper::InternalState::Order
vtkViewDependentTextureMapper::InternalState::OrderOfLayers() const
{
  const double margin = 0.02; // for what lies between the samples
  std::vector<double> chords;
  for (const int view : this->layers)
  {
    const Eigen::Vector3d center = this->photographs[view].camera.Center();
    double least = 2;
    for (const Eigen::Vector3d& sample : this->samples)
    {
      const Eigen::Vector3d toNovel = (this->novel.center - sample).normalized();
      least = std::min(least, ((center - sample).normalized() - toNovel).norm());
    }
    chords.push_back(least - margin);
  }
  Order order;
  order.layers.resize(chords.size());
  std::iota(order.layers.begin(), order.layers.end(), 0);
  std::stable_sort(
    order.layers.begin(), order.layers.end(), [&](int a, int b) { return chords[a] < chords[b]; });
  for (const int layer : order.layers)
  {
    order.chords.push_back(static_cast<float>(chords[layer]));
  }
  return order;
}

vtkViewDependentTextureMapper::vtkViewDependentTextureMapper()
  : Internals(new InternalState)
{
  this->ScalarVisibilityOff();
}

vtkViewDependentTextureMapper::~vtkViewDependentTextureMapper()
{
  this->Internals->DeleteTexturesOfWindow();
}

void vtkViewDependentTextureMapper::SetPhotographs(vtkMultiBlockDataSet* photographs)
{
  if (this->Photographs != photographs)
  {
    this->Photographs = photographs;
    this->Internals->photographsTime = vtkTimeStamp();
    this->Modified();
  }
}

vtkMultiBlockDataSet* vtkViewDependentTextureMapper::GetPhotographs()
{
  return this->Photographs;
}

int vtkViewDependentTextureMapper::GetNumberOfViewsInUse()
{
  return static_cast<int>(this->Internals->layers.size());
}

std::string vtkViewDependentTextureMapper::GetViewInUse(int index)
{
  const InternalState& state = *this->Internals;
  return index >= 0 && index < this->GetNumberOfViewsInUse()
    ? state.photographs[state.layers[index]].name
    : std::string();
}

void vtkViewDependentTextureMapper::InternalState::MakeProgram(int blended)
{
  if (this->coloring && this->blendedViews == blended)
  {
    return;
  }
  const std::string source = "//VTK::System::Dec\n//VTK::Output::Dec\n#define BLENDED_VIEWS " +
    std::to_string(blended) + "\n" + freespace::ViewDependentTextureShader;
  this->coloring.reset(new vtkOpenGLQuadHelper(this->window, nullptr, source.c_str(), nullptr));
  this->blendedViews = blended;
}

void vtkViewDependentTextureMapper::InternalState::SetParameters(vtkShaderProgram* program) const
{
  const int count = static_cast<int>(this->layers.size());
  float rows[3 * freespace::ShaderMaximumViews][4] = {};
  float centers[freespace::ShaderMaximumViews][4] = {};
  float factors[freespace::ShaderMaximumViews] = {};
  for (int i = 0; i < count; ++i)
  {
    const Camera& camera = this->photographs[this->layers[i]].camera;
    Eigen::Matrix<double, 3, 4> pixelFromSurface;
    pixelFromSurface << camera.K * camera.R, camera.K * (camera.R * this->origin + camera.t);
    for (int row = 0; row < 3; ++row)
    {
      Eigen::RowVector4f::Map(rows[3 * i + row]) = pixelFromSurface.row(row).cast<float>();
    }
    Eigen::Vector4d center;
    center << camera.Center() - this->origin, std::sqrt(camera.K(0, 0) * camera.K(1, 1));
    Eigen::Vector4f::Map(centers[i]) = center.cast<float>();
    factors[i] = static_cast<float>(1 - this->maps[this->layers[i]].tolerance);
  }
  const Order order = this->OrderOfLayers();
  program->SetUniformi("viewCount", count);
  program->SetUniform1iv("viewOrder", count, order.layers.data());
  program->SetUniform1fv("viewChords", count, order.chords.data());
  program->SetUniform4fv("viewRows", 3 * freespace::ShaderMaximumViews, rows);
  program->SetUniform4fv("viewCenters", freespace::ShaderMaximumViews, centers);
  program->SetUniform1fv("disparityFactors", freespace::ShaderMaximumViews, factors);

  Eigen::Vector4d novelCenter;
  novelCenter << this->novel.center - this->origin, this->novel.focal;
  Eigen::Matrix4d clip = this->novel.clipFromSurface;
  clip.col(3) += clip.leftCols<3>() * this->origin;
  program->SetUniform4f("novelCenter", novelCenter.cast<float>().eval().data());
  program->SetUniform3f("novelRight", this->novel.axes.row(0).eval().data());
  program->SetUniform3f("novelUp", this->novel.axes.row(1).eval().data());
  program->SetUniform3f("novelForward", this->novel.axes.row(2).eval().data());
  program->SetUniform4f("clipDepth", clip.row(2).cast<float>().eval().data());
  program->SetUniform4f("clipScale", clip.row(3).cast<float>().eval().data());

  const float layerSize[2] = { float(this->layerWidth), float(this->layerHeight) };
  program->SetUniform2f("layerSize", layerSize);
  program->SetUniformf("feather", static_cast<float>(this->feather));
  program->SetUniformi("geometrySamples", this->geometry.GetSamples());
  program->SetUniformi("geometry", this->geometryUnit);
  program->SetUniformi("photographs", this->colorUnit);
  program->SetUniformi("visibility", this->visibilityUnit);
}

void vtkViewDependentTextureMapper::UpdateTextures(vtkRenderer* renderer, vtkActor* actor)
{
  InternalState& state = *this->Internals;
  vtkOpenGLState* gl = state.window->GetState();
  this->GetInputAlgorithm()->Update();
  GLint longest = 16;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &longest);
  if (this->Photographs)
  {
    state.UpdatePhotographs(this->Photographs, std::min(this->MaximumPhotographSize, longest));
  }
  else
  {
    state.photographs.clear();
    state.DeleteTextures();
  }
  state.UpdateMaps(this->GetInput(), this->Feather, this->Tolerance);
  state.novel = FindNovelCamera(renderer, actor);
  if (!state.photographs.empty())
  {
    state.UpdateLayers(gl, this->MaximumNumberOfViews, this->TextureMemory * 1048576.0);
    state.visibility.Bind(gl, state.visibilityUnit);
    state.colors.Bind(gl, state.colorUnit);
  }
}

bool vtkViewDependentTextureMapper::DrawGeometry(vtkRenderer* renderer, vtkActor* actor)
{
  InternalState& state = *this->Internals;
  vtkOpenGLState* gl = state.window->GetState();
  int size[2];
  int corner[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &corner[0], &corner[1]);
  gl->PushFramebufferBindings();
  state.geometry.Bind(gl, size[0], size[1], this->EdgeSamples, state.geometryUnit);
  if (state.geometry.IsComplete())
  {
    const vtkOpenGLState::ScopedglViewport keepViewport(gl);
    const vtkOpenGLState::ScopedglScissor keepScissor(gl);
    const vtkOpenGLState::ScopedglEnableDisable keepBlend(gl, GL_BLEND);
    const vtkOpenGLState::ScopedglClearColor keepClearColor(gl);
    gl->vtkglViewport(0, 0, size[0], size[1]);
    gl->vtkglScissor(0, 0, size[0], size[1]);
    gl->vtkglDisable(GL_BLEND);
    gl->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    this->Superclass::RenderPiece(renderer, actor);
  }
  gl->PopFramebufferBindings();
  return state.geometry.IsComplete();
}

void vtkViewDependentTextureMapper::DrawColors(vtkActor* actor)
{
  InternalState& state = *this->Internals;
  vtkOpenGLState* gl = state.window->GetState();
  state.MakeProgram(this->BlendedViews);
  vtkShaderProgram* program = state.coloring->Program;
  if (!program)
  {
    return; // told by VTK
  }
  state.window->GetShaderCache()->ReadyShaderProgram(program);
  state.geometry.BindTexture(gl, state.geometryUnit);
  state.SetParameters(program);
  program->SetUniform3f("unseenColor", this->UnseenColor);
  program->SetUniformf("opacity", static_cast<float>(actor->GetProperty()->GetOpacity()));
  // Pixels that the surface covers in part are mixed with what is behind.
  const vtkOpenGLState::ScopedglEnableDisable keepBlend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate keepBlending(gl);
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state.coloring->Render();
}

void vtkViewDependentTextureMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetSelector())
  {
    this->Superclass::RenderPiece(renderer, actor);
    return;
  }
  InternalState& state = *this->Internals;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  state.UseWindow(window);
  vtkTextureUnitManager* units = window->GetState()->GetTextureUnitManager();
  state.geometryUnit = units->Allocate();
  state.colorUnit = units->Allocate();
  state.visibilityUnit = units->Allocate();
  try
  {
    this->UpdateTextures(renderer, actor);
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
    state.photographs.clear();
    state.maps.clear();
    state.DeleteTextures();
  }
  if (this->DrawGeometry(renderer, actor))
  {
    this->DrawColors(actor);
  }
  else
  {
    vtkErrorMacro("The OpenGL context has no framebuffer for the positions of the surface.");
  }
  units->Free(state.geometryUnit);
  units->Free(state.colorUnit);
  units->Free(state.visibilityUnit);
}

void vtkViewDependentTextureMapper::ReplaceShaderLight(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\nuniform vec3 surfaceUnscale;\nout vec3 surfacePosition;\n");
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Impl",
    "//VTK::PositionVC::Impl\n  surfacePosition = vertexMC.xyz * surfaceUnscale;\n");
  shaders[vtkShader::Vertex]->SetSource(vertex);

  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(
    fragment, "//VTK::Light::Dec", freespace::SurfaceGeometryDeclaration);
  vtkShaderProgram::Substitute(fragment, "//VTK::UniformFlow::Impl",
    "vec3 surfaceDx = dFdx(surfacePosition);\n  vec3 surfaceDy = dFdy(surfacePosition);\n"
    "  //VTK::UniformFlow::Impl");
  vtkShaderProgram::Substitute(fragment, "//VTK::Light::Impl", freespace::SurfaceGeometryOutput);
  shaders[vtkShader::Fragment]->SetSource(fragment);
}

void vtkViewDependentTextureMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);
  // The vertices are x' = (x - shift) * scale where coordinates are large.
  vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC");
  float unscale[3] = { 1, 1, 1 };
  Eigen::Vector3d origin(0, 0, 0);
  if (positions && positions->GetCoordShiftAndScaleEnabled())
  {
    for (int i = 0; i < 3; ++i)
    {
      unscale[i] = static_cast<float>(1 / positions->GetScale()[i]);
      origin[i] = positions->GetShift()[i];
    }
  }
  this->Internals->origin = origin;
  cellBO.Program->SetUniform3f("surfaceUnscale", unscale);
}

void vtkViewDependentTextureMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window == this->Internals->window)
  {
    this->Internals->DeleteAll();
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkViewDependentTextureMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
  os << indent << "BlendedViews: " << this->BlendedViews << "\n";
  os << indent << "Feather: " << this->Feather << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EdgeSamples: " << this->EdgeSamples << "\n";
  os << indent << "MaximumNumberOfViews: " << this->MaximumNumberOfViews << "\n";
  os << indent << "MaximumPhotographSize: " << this->MaximumPhotographSize << "\n";
  os << indent << "TextureMemory: " << this->TextureMemory << "\n";
  os << indent << "UnseenColor: " << this->UnseenColor[0] << " " << this->UnseenColor[1] << " "
     << this->UnseenColor[2] << "\n";
  os << indent << "NumberOfViewsInUse: " << this->GetNumberOfViewsInUse() << "\n";
}
