// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_GeometryBuffer_h
#define freespace_GeometryBuffer_h

#include <vtkNew.h>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace freespace
{

/// The framebuffer in which the geometry of the surface is drawn: a multisampled texture of four floats
/// and a depth buffer.
class GeometryBuffer
{
public:
  GeometryBuffer();
  ~GeometryBuffer();

  /// Makes it the framebuffer of the window's context, with this size and at most this number of samples.
  /// Returns false when the context does not support it.
  bool Bind(vtkOpenGLRenderWindow* window, int width, int height, int samples);

  vtkTextureObject* GetTexture() const;
  int GetSamples() const { return this->Samples; }
  void Release(vtkOpenGLRenderWindow* window);

private:
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  int Width = 0;
  int Height = 0;
  int AskedSamples = 0;
  int Samples = 0;
  bool Complete = false;
};

}

#endif
