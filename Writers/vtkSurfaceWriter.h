// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceWriter
 * @brief write a surface as PLY, STL, OBJ or VTP, chosen by the file's ending
 *
 * The file is written beside its target and renamed, so that the target is either the old file or the
 * whole new one. PLY and STL are binary; only VTP keeps the data arrays. An ending that is none of
 * these, or a folder that cannot be written, is an error that names the file; Write() then returns 0.
 */
#ifndef vtkSurfaceWriter_h
#define vtkSurfaceWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
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
   * The file to write; its ending (.ply, .stl, .obj or .vtp) chooses the format.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /**
   * Whether the ending of a file name is one that this class writes.
   */
  static bool CanWriteFile(const std::string& fileName);

protected:
  vtkSurfaceWriter() = default;
  ~vtkSurfaceWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;

private:
  vtkSurfaceWriter(const vtkSurfaceWriter&) = delete;
  void operator=(const vtkSurfaceWriter&) = delete;
};

#endif
