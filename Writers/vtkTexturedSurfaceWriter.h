// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTexturedSurfaceWriter
 * @brief write a surface with its texture as GLB, OBJ or PLY, chosen by the file's ending
 *
 * Input port 0: a vtkPolyData of triangles with texture coordinates; port 1: the texture, a vtkImageData
 * of unsigned chars (both are the outputs of a vtkTextureBaker). A .glb holds everything in one
 * file, shown unlit because the photographs hold the light; an .obj has a .mtl and a .png beside it; a
 * .ply has the colours of points (their unsigned char scalars) in place of a texture.
 *
 * glTF looks along its own axes: y is up. With ZUp (default on) the GLB's node turns z up into y up; the
 * coordinates themselves are kept, relative to the node's translation where they are large.
 *
 * Files are written beside their target and renamed. An ending that is none of these, a surface without
 * texture coordinates or colours, or a folder that cannot be written is an error that names the
 * file; Write() then returns 0.
 */
#ifndef vtkTexturedSurfaceWriter_h
#define vtkTexturedSurfaceWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
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
   * The file to write; its ending (.glb, .obj or .ply) chooses the format.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * Whether z is up in the scene, which a GLB then turns. Default on.
   */
  vtkSetMacro(ZUp, vtkTypeBool);
  vtkGetMacro(ZUp, vtkTypeBool);
  vtkBooleanMacro(ZUp, vtkTypeBool);
  ///@}

  /**
   * Whether the ending of a file name is one that this class writes.
   */
  static bool CanWriteFile(const std::string& fileName);

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
