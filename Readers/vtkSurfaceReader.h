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
  virtual void SetFileName(VTK_FILEPATH const std::string& fileName)
  {
    if (this->FileName != fileName)
    {
      this->FileName = fileName;
      this->Modified();
    }
  }
  void SetFileName(VTK_FILEPATH const char* fileName) // null is no name
  {
    this->SetFileName(std::string(fileName ? fileName : ""));
  }
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
