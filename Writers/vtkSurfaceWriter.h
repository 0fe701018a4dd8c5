// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceWriter
 * @brief write a surface as PLY, STL, OBJ or VTP, by the file's extension
 *
 * The file is written beside its target and renamed, so that the target is either the old file or the
 * complete new one. PLY and STL are binary; a PLY has double precision if single precision does not
 * represent every coordinate, and an STL that would lose the surface is an error: see GlobalShift. Only VTP stores all data
 * arrays; a PLY has the point data RGB (unsigned char x3) as colours and Normals, where they are, and an OBJ
 * the normals. Another extension, or a folder that cannot be written, is an error that names the file; Write()
 * then returns 0.
 *
 * @sa vtkSurfaceReader vtkFreespaceSurfaceFilter vtkTexturedSurfaceWriter
 */
#ifndef vtkSurfaceWriter_h
#define vtkSurfaceWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkWriter.h"

#include <string> // for FileName

class VTKFREESPACEWRITERS_EXPORT vtkSurfaceWriter : public vtkWriter
{
public:
  static vtkSurfaceWriter* New();
  vtkTypeMacro(vtkSurfaceWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; its extension (.ply, .stl, .obj or .vtp) determines the format.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Subtracted from all coordinates: a scene far from the origin, as in UTM coordinates, has them in single precision,
   * which STL and many programs are limited to, only like that. The file tells the shift: PLY and OBJ in a comment
   * "global shift X Y Z", STL in its header, VTP in the field data GlobalShift; vtkSurfaceReader adds it again.
   * Default 0, 0, 0.
   */
  vtkSetVector3Macro(GlobalShift, double);
  vtkGetVector3Macro(GlobalShift, double);
  ///@}

  /**
   * A global shift for a surface's bounds: 0 where single precision rounds by less than 1e-5 of the diagonal,
   * otherwise the middle, rounded to a power of ten that is no smaller than the diagonal.
   */
  static void SuggestGlobalShift(const double bounds[6], double shift[3]);

  ///@{
  /**
   * Whether a .vtp has its arrays inline, as text, and not appended as bytes: larger, for programs that cannot read the
   * latter, such as ParaView 5.11 with the libexpat of Debian 12. Default off.
   */
  vtkSetMacro(InlineArrays, vtkTypeBool);
  vtkGetMacro(InlineArrays, vtkTypeBool);
  vtkBooleanMacro(InlineArrays, vtkTypeBool);
  ///@}

  /**
   * Whether the class writes files with this extension.
   */
  static bool CanWriteFile(VTK_FILEPATH const std::string& fileName);

protected:
  vtkSurfaceWriter() = default;
  ~vtkSurfaceWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;
  double GlobalShift[3] = { 0, 0, 0 };
  vtkTypeBool InlineArrays = false;

private:
  vtkSurfaceWriter(const vtkSurfaceWriter&) = delete;
  void operator=(const vtkSurfaceWriter&) = delete;
};

#endif
