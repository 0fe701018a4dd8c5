// SPDX-License-Identifier: BSD-3-Clause
#include "ViewDependent/LayeredTexture.h"

#include "ViewDependent/OpenGLFunctions.h"

#include <vtkOpenGLState.h>

namespace freespace
{

void LayeredTexture::Create(vtkOpenGLState* state, int width, int height, int layers,
  unsigned int internalFormat, unsigned int format, unsigned int type, bool mipmaps)
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

void LayeredTexture::Upload(int layer, const void* texels)
{
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, this->Width, this->Height, 1, this->Format,
    this->Type, texels);
}

void LayeredTexture::Bind(vtkOpenGLState* state, int unit)
{
  state->vtkglActiveTexture(GL_TEXTURE0 + static_cast<unsigned int>(unit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->Name);
}

void LayeredTexture::Delete()
{
  if (this->Name)
  {
    glDeleteTextures(1, &this->Name);
    this->Name = 0;
  }
}

}
