// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceReader
 * @brief read a surface from PLY, STL, OBJ or VTP, chosen by the file's ending
 *
 * The counterpart of vtkSurfaceWriter. Polygons come as triangles. A file that is missing, of another
 * ending, or without a single triangle is an error that names it; the output is then empty.
 */
#ifndef vtkSurfaceReader_h
#define vtkSurfaceReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
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
   * The file to read; its ending (.ply, .stl, .obj or .vtp) tells the format.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
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
