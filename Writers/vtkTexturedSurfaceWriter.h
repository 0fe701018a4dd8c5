// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTexturedSurfaceWriter
 * @brief write a surface with its texture as GLB, OBJ or PLY, by the file's extension
 *
 * Input port 0: a vtkPolyData of triangles with texture coordinates; port 1: the texture, a vtkImageData of
 * unsigned chars. Both are outputs of a vtkTextureBaker. A .glb contains everything in one file, unlit
 * because the images contain the light; an .obj has a .mtl and a .png beside it; a .ply has colours of
 * points (their unsigned char scalars) instead of a texture.
 *
 * In glTF y is up. With ZUp (default on) the node of the GLB rotates z up to y up; the coordinates
 * themselves are unchanged, relative to the node's translation if they are large.
 *
 * Files are written beside their target and renamed. Another extension, a surface without texture
 * coordinates or colours, and a folder that cannot be written are errors that name the file; Write() then
 * returns 0.
 *
 * @sa vtkTextureBaker vtkSurfaceWriter
 */
#ifndef vtkTexturedSurfaceWriter_h
#define vtkTexturedSurfaceWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkWriter.h"

#include <string> // for FileName

class VTKFREESPACEWRITERS_EXPORT vtkTexturedSurfaceWriter : public vtkWriter
{
public:
  static vtkTexturedSurfaceWriter* New();
  vtkTypeMacro(vtkTexturedSurfaceWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; its extension (.glb, .obj or .ply) determines the format.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Whether z is up in the scene; a GLB is then rotated to y up. Default on.
   */
  vtkSetMacro(ZUp, vtkTypeBool);
  vtkGetMacro(ZUp, vtkTypeBool);
  vtkBooleanMacro(ZUp, vtkTypeBool);
  ///@}

  /**
   * Whether the class writes files with this extension.
   */
  static bool CanWriteFile(VTK_FILEPATH const std::string& fileName);

protected:
  vtkTexturedSurfaceWriter();
  ~vtkTexturedSurfaceWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;
  vtkTypeBool ZUp = true;

private:
  vtkTexturedSurfaceWriter(const vtkTexturedSurfaceWriter&) = delete;
  void operator=(const vtkTexturedSurfaceWriter&) = delete;
};

#endif
