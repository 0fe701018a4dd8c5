// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LayeredTexture_h
#define freespace_LayeredTexture_h

class vtkOpenGLState;

namespace freespace
{

/// A 2D texture array of the OpenGL context, one layer for each view. vtkTextureObject has none.
class LayeredTexture
{
public:
  /// Allocates the layers; the texture stays bound.
  void Create(vtkOpenGLState* state, int width, int height, int layers, unsigned int internalFormat,
    unsigned int format, unsigned int type, bool mipmaps);

  /// Fills a whole layer of the texture, which must be bound.
  void Upload(int layer, const void* texels);

  void Bind(vtkOpenGLState* state, int unit = 0);

  /// The context must be current.
  void Delete();

  bool Exists() const { return this->Name != 0; }

private:
  unsigned int Name = 0;
  unsigned int Format = 0;
  unsigned int Type = 0;
  int Width = 0;
  int Height = 0;
};

}

#endif
