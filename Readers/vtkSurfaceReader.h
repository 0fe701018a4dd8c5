// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceReader
 * @brief read a surface from PLY, STL, OBJ or VTP, by the file's extension
 *
 * The counterpart of vtkSurfaceWriter. Polygons are converted to triangles. A file that is missing, has
 * another extension, or has no triangles is an error that names it; the output is then empty.
 *
 * @sa vtkSurfaceWriter vtkSurfacePicture
 */
#ifndef vtkSurfaceReader_h
#define vtkSurfaceReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkPolyDataAlgorithm.h"

#include <string> // for FileName

class VTKFREESPACEREADERS_EXPORT vtkSurfaceReader : public vtkPolyDataAlgorithm
{
public:
  static vtkSurfaceReader* New();
  vtkTypeMacro(vtkSurfaceReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read; its extension (.ply, .stl, .obj or .vtp) determines the format.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

protected:
  vtkSurfaceReader();
  ~vtkSurfaceReader() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;

private:
  vtkSurfaceReader(const vtkSurfaceReader&) = delete;
  void operator=(const vtkSurfaceReader&) = delete;
};

#endif
