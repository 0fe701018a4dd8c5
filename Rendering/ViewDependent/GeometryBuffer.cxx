// SPDX-License-Identifier: BSD-3-Clause
#include "ViewDependent/GeometryBuffer.h"

#include "ViewDependent/OpenGLFunctions.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkTextureObject.h>
#include <vtkType.h>

#include <algorithm>

namespace freespace
{

GeometryBuffer::GeometryBuffer() = default;
GeometryBuffer::~GeometryBuffer() = default;

bool GeometryBuffer::Bind(vtkOpenGLRenderWindow* window, int width, int height, int samples)
{
  if (this->Framebuffer->GetContext() == window && width == this->Width && height == this->Height &&
    samples == this->AskedSamples)
  {
    this->Framebuffer->Bind(GL_FRAMEBUFFER);
    return this->Complete;
  }
  this->Release(window);
  GLint color = 1;
  GLint depth = 1;
  glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &color);
  glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depth);
  this->Width = width;
  this->Height = height;
  this->AskedSamples = samples;
  this->Samples = std::max(1, std::min({ samples, color, depth }));
  this->Framebuffer->SetContext(window);
  this->Complete = this->Framebuffer->PopulateFramebuffer(
    width, height, true, 1, VTK_FLOAT, true, 24, this->Samples);
  return this->Complete;
}

vtkTextureObject* GeometryBuffer::GetTexture() const
{
  return this->Framebuffer->GetColorAttachmentAsTextureObject(0);
}

void GeometryBuffer::Release(vtkOpenGLRenderWindow* window)
{
  if (this->Framebuffer->GetContext())
  {
    this->Framebuffer->ReleaseGraphicsResources(window);
  }
  this->Width = this->Height = this->AskedSamples = this->Samples = 0;
  this->Complete = false;
}

}
