// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewDependentTextureMapper.h"

#include "Common/Error.h"
#include "Data/SurfaceMesh.h"
#include "PhotographBlocks.h"
#include "SurfaceGeometry.h"
#include "ViewDependent/GeometryBuffer.h"
#include "ViewDependent/NovelCamera.h"
#include "ViewDependent/OpenGLFunctions.h"
#include "ViewDependent/PhotographLayers.h"
#include "ViewDependentTexture.h"

#include <vtkActor.h>
#include <vtkMultiBlockDataSet.h>
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
#include <vtkTextureObject.h>
#include <vtkTextureUnitManager.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkViewDependentTextureMapper);

using freespace::Camera;

namespace
{

constexpr int ShaderMaximumViews = 64; // the length of the arrays in ViewDependentTexture.glsl

}

struct vtkViewDependentTextureMapper::InternalState
{
  freespace::PhotographLayers photographs;
  vtkTimeStamp photographsTime;
  vtkTimeStamp mapsTime;
  int longestSide = 0;
  freespace::VisibilityOptions visibility; // of the maps

  freespace::GeometryBuffer geometry;
  std::unique_ptr<vtkOpenGLQuadHelper> coloring;
  int blendedViews = 0; // that the program of coloring was made for
  int colorUnit = -1;
  int visibilityUnit = -1;
  freespace::NovelCamera novel;
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
    this->photographs.DeleteTextures();
    this->geometry.Release(this->window);
    if (this->coloring)
    {
      this->coloring->ReleaseGraphicsResources(this->window);
      this->coloring.reset();
    }
  }

  void UpdatePhotographs(vtkMultiBlockDataSet* blocks, int longest);
  void UpdateMaps(vtkPolyData* surface, double feather, double tolerance);
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
  this->photographs.RemovePhotographs();
  this->photographsTime.Modified(); // also when it fails: the error is reported once
  this->longestSide = longest;
  this->photographs.SetPhotographs(freespace::PhotographsFromBlocks(blocks), longest);
}

void vtkViewDependentTextureMapper::InternalState::UpdateMaps(
  vtkPolyData* surface, double feather, double tolerance)
{
  if (this->photographs.HasMaps() && this->mapsTime > surface->GetMTime() &&
    this->visibility.feather == feather && this->visibility.tolerance == tolerance)
  {
    return;
  }
  this->visibility.feather = feather;
  this->visibility.tolerance = tolerance;
  this->photographs.MakeMaps(freespace::MeshFromPolyData(surface), this->visibility);
  this->mapsTime.Modified();
}

void vtkViewDependentTextureMapper::InternalState::MakeProgram(int blended)
{
  if (this->coloring && this->blendedViews == blended)
  {
    return;
  }
  const std::string source = "//VTK::System::Dec\n//VTK::Output::Dec\n#define BLENDED_VIEWS " +
    std::to_string(blended) + "\n" + ViewDependentTexture;
  this->coloring =
    std::make_unique<vtkOpenGLQuadHelper>(this->window, nullptr, source.c_str(), nullptr);
  this->blendedViews = blended;
}

void vtkViewDependentTextureMapper::InternalState::SetParameters(vtkShaderProgram* program) const
{
  const int count = this->photographs.NumberOfLayers();
  float rows[3 * ShaderMaximumViews][4] = {};
  float centers[ShaderMaximumViews][4] = {};
  float factors[ShaderMaximumViews] = {};
  for (int i = 0; i < count; ++i)
  {
    const Camera& camera = this->photographs.PhotographOf(i).camera;
    Eigen::Matrix<double, 3, 4> pixelFromSurface;
    pixelFromSurface << camera.K * camera.R, camera.K * (camera.R * this->origin + camera.t);
    for (int row = 0; row < 3; ++row)
    {
      Eigen::RowVector4f::Map(rows[3 * i + row]) = pixelFromSurface.row(row).cast<float>();
    }
    Eigen::Vector4d center;
    center << camera.Center() - this->origin, camera.FocalLength();
    Eigen::Vector4f::Map(centers[i]) = center.cast<float>();
    factors[i] = static_cast<float>(1 - this->photographs.MapOf(i).tolerance);
  }
  const freespace::ViewOrder order = this->photographs.OrderLayers(this->novel.center);
  program->SetUniformi("viewCount", count);
  program->SetUniform1iv("viewOrder", count, order.views.data());
  program->SetUniform1fv("viewChords", count, order.chords.data());
  program->SetUniform4fv("viewRows", 3 * ShaderMaximumViews, rows);
  program->SetUniform4fv("viewCenters", ShaderMaximumViews, centers);
  program->SetUniform1fv("disparityFactors", ShaderMaximumViews, factors);

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

  const float layerSize[2] = { float(this->photographs.Width()),
    float(this->photographs.Height()) };
  program->SetUniform2f("layerSize", layerSize);
  program->SetUniformf("feather", static_cast<float>(this->visibility.feather));
  program->SetUniformi("geometrySamples", this->geometry.GetSamples());
  program->SetUniformi("geometry", this->geometry.GetTexture()->GetTextureUnit());
  program->SetUniformi("photographs", this->colorUnit);
  program->SetUniformi("visibility", this->visibilityUnit);
}

vtkViewDependentTextureMapper::vtkViewDependentTextureMapper()
  : Internals(new InternalState)
{
  this->ScalarVisibilityOff();
  const freespace::VisibilityOptions visibility;
  this->Feather = visibility.feather;
  this->Tolerance = visibility.tolerance;
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
  return this->Internals->photographs.NumberOfLayers();
}

std::string vtkViewDependentTextureMapper::GetViewInUse(int index)
{
  return index >= 0 && index < this->GetNumberOfViewsInUse()
    ? this->Internals->photographs.PhotographOf(index).name
    : std::string();
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
    state.photographs.RemovePhotographs();
  }
  state.UpdateMaps(this->GetInput(), this->Feather, this->Tolerance);
  state.novel = freespace::FindNovelCamera(renderer, actor);
  if (!state.photographs.IsEmpty())
  {
    state.photographs.UpdateLayers(gl, state.novel.center, this->MaximumNumberOfViews,
      this->TextureMemory * 1048576.0, state.colorUnit, state.visibilityUnit);
    state.photographs.Bind(gl, state.colorUnit, state.visibilityUnit);
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
  const bool complete = state.geometry.Bind(state.window, size[0], size[1], this->EdgeSamples);
  if (complete)
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
  return complete;
}

void vtkViewDependentTextureMapper::DrawColors(vtkActor* actor)
{
  InternalState& state = *this->Internals;
  vtkOpenGLState* gl = state.window->GetState();
  state.MakeProgram(this->BlendedViews);
  vtkShaderProgram* program = state.coloring->Program;
  if (!program)
  {
    return; // VTK has reported it
  }
  state.window->GetShaderCache()->ReadyShaderProgram(program);
  state.geometry.GetTexture()->Activate();
  state.SetParameters(program);
  program->SetUniform3f("unseenColor", this->UnseenColor);
  program->SetUniformf("opacity", static_cast<float>(actor->GetProperty()->GetOpacity()));
  // Pixels that the surface covers in part are mixed with what is behind.
  const vtkOpenGLState::ScopedglEnableDisable keepBlend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate keepBlending(gl);
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state.coloring->Render();
  state.geometry.GetTexture()->Deactivate();
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
  state.colorUnit = units->Allocate();
  state.visibilityUnit = units->Allocate();
  try
  {
    this->UpdateTextures(renderer, actor);
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
    state.photographs.RemovePhotographs();
  }
  if (this->DrawGeometry(renderer, actor))
  {
    this->DrawColors(actor);
  }
  else
  {
    vtkErrorMacro("The OpenGL context has no framebuffer for the positions of the surface.");
  }
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
  vtkShaderProgram::Substitute(fragment, "//VTK::Light::Dec", SurfaceGeometry);
  vtkShaderProgram::Substitute(fragment, "//VTK::UniformFlow::Impl",
    "vec3 surfaceDx = dFdx(surfacePosition);\n  vec3 surfaceDy = dFdy(surfacePosition);\n"
    "  //VTK::UniformFlow::Impl");
  vtkShaderProgram::Substitute(fragment, "//VTK::Light::Impl",
    "gl_FragData[0] = vec4(surfacePosition, foldedNormal(cross(surfaceDx, surfaceDy)));\n");
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
