// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewDependentTextureMapper.h"

#include "CameraForVTK.h"
#include "Error.h"
#include "PhotographBlocks.h"
#include "SMPParallelFor.h"
#include "ViewDependentTextureShader.h"
#include "VisibilityMap.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPolyData.h>
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

// Where the renderer's camera is, in the coordinates of the surface, and its focal length in
// pixels.
struct NovelCamera
{
  Eigen::Vector3d center;
  double focal = 1;
};

NovelCamera FindNovelCamera(vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  double position[4] = { 0, 0, 0, 1 };
  camera->GetPosition(position);
  if (camera->GetParallelProjection())
  {
    double direction[3];
    camera->GetDirectionOfProjection(direction);
    for (int i = 0; i < 3; ++i)
    {
      position[i] -= 1e4 * camera->GetDistance() * direction[i];
    }
  }
  vtkNew<vtkMatrix4x4> surfaceFromWorld;
  actor->GetMatrix(surfaceFromWorld);
  surfaceFromWorld->Invert();
  surfaceFromWorld->MultiplyPoint(position, position);
  const double halfAngle = vtkMath::RadiansFromDegrees(camera->GetViewAngle()) / 2;
  return { Eigen::Vector3d(position) / position[3],
    renderer->GetSize()[1] / (2 * std::tan(halfAngle)) };
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
    if (this->window && this->colors.IsThere())
    {
      this->window->MakeCurrent();
      this->DeleteTextures();
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
  const Photograph& photograph = this->photographs[this->layers[layer]];
  const VisibilityMap& map = this->maps[this->layers[layer]];
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

void vtkViewDependentTextureMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  InternalState& state = *this->Internals;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  state.UseWindow(window);
  vtkTextureUnitManager* units = window->GetState()->GetTextureUnitManager();
  state.colorUnit = units->Allocate();
  state.visibilityUnit = units->Allocate();
  try
  {
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
    }
    state.UpdateMaps(this->GetInput(), this->Feather, this->Tolerance);
    state.novel = FindNovelCamera(renderer, actor);
    if (!state.photographs.empty())
    {
      state.UpdateLayers(
        window->GetState(), this->MaximumNumberOfViews, this->TextureMemory * 1048576.0);
      state.visibility.Bind(window->GetState(), state.visibilityUnit);
      state.colors.Bind(window->GetState(), state.colorUnit);
    }
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
    state.photographs.clear();
    state.maps.clear();
    state.DeleteTextures();
  }
  this->Superclass::RenderPiece(renderer, actor);
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
  vtkShaderProgram::Substitute(fragment, "//VTK::Light::Dec",
    "#define BLENDED_VIEWS " + std::to_string(this->BlendedViews) + "\n" +
      freespace::ViewDependentTextureShader);
  vtkShaderProgram::Substitute(fragment, "//VTK::UniformFlow::Impl",
    "vec3 surfaceDx = dFdx(surfacePosition);\n  vec3 surfaceDy = dFdy(surfacePosition);\n"
    "  //VTK::UniformFlow::Impl");
  vtkShaderProgram::Substitute(fragment, "//VTK::Light::Impl",
    "gl_FragData[0] = vec4(viewDependentColor(surfacePosition, surfaceDx, surfaceDy), opacity);\n"
    "  //VTK::Light::Impl");
  shaders[vtkShader::Fragment]->SetSource(fragment);
}

void vtkViewDependentTextureMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);
  InternalState& state = *this->Internals;
  vtkShaderProgram* program = cellBO.Program;

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
  const int count = static_cast<int>(state.layers.size());
  float rows[3 * freespace::ShaderMaximumViews][4] = {};
  float centers[freespace::ShaderMaximumViews][4] = {};
  for (int i = 0; i < count; ++i)
  {
    const Camera& camera = state.photographs[state.layers[i]].camera;
    Eigen::Matrix<double, 3, 4> pixelFromSurface;
    pixelFromSurface << camera.K * camera.R, camera.K * (camera.R * origin + camera.t);
    for (int row = 0; row < 3; ++row)
    {
      Eigen::RowVector4f::Map(rows[3 * i + row]) = pixelFromSurface.row(row).cast<float>();
    }
    Eigen::Vector4d center;
    center << camera.Center() - origin, std::sqrt(camera.K(0, 0) * camera.K(1, 1));
    Eigen::Vector4f::Map(centers[i]) = center.cast<float>();
  }
  Eigen::Vector4d novel;
  novel << state.novel.center - origin, state.novel.focal;
  const Eigen::Vector4f novelCenter = novel.cast<float>();
  const float layerSize[2] = { float(state.layerWidth), float(state.layerHeight) };

  program->SetUniform3f("surfaceUnscale", unscale);
  program->SetUniformi("viewCount", count);
  const InternalState::Order order = state.OrderOfLayers();
  program->SetUniform1iv("viewOrder", count, order.layers.data());
  program->SetUniform1fv("viewChords", count, order.chords.data());
  program->SetUniform4fv("viewRows", 3 * freespace::ShaderMaximumViews, rows);
  program->SetUniform4fv("viewCenters", freespace::ShaderMaximumViews, centers);
  program->SetUniform2f("layerSize", layerSize);
  program->SetUniform4f("novelCenter", novelCenter.data());
  program->SetUniformf("disparityFactor", static_cast<float>(1 - this->Tolerance));
  program->SetUniform3f("unseenColor", this->UnseenColor);
  program->SetUniformi("photographs", state.colorUnit);
  program->SetUniformi("visibility", state.visibilityUnit);
}

void vtkViewDependentTextureMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window == this->Internals->window)
  {
    this->Internals->DeleteTextures();
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
  os << indent << "MaximumNumberOfViews: " << this->MaximumNumberOfViews << "\n";
  os << indent << "MaximumPhotographSize: " << this->MaximumPhotographSize << "\n";
  os << indent << "TextureMemory: " << this->TextureMemory << "\n";
  os << indent << "UnseenColor: " << this->UnseenColor[0] << " " << this->UnseenColor[1] << " "
     << this->UnseenColor[2] << "\n";
  os << indent << "NumberOfViewsInUse: " << this->GetNumberOfViewsInUse() << "\n";
}
