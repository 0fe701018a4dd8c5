// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewBlocksReader
 * @brief read features or disparity maps from a .vtm file
 *
 * The counterpart of vtkViewBlocksWriter. Unlike vtkXMLMultiBlockDataReader it does not accept partial
 * data: a missing or truncated file, a missing block, and a block without its arrays or with an invalid
 * camera are errors that name the file and the view; the output is then empty.
 *
 * @sa vtkViewBlocksWriter vtkDelaunayDisparityFilter
 */
#ifndef vtkViewBlocksReader_h
#define vtkViewBlocksReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <string> // for FileName

class VTKFREESPACEREADERS_EXPORT vtkViewBlocksReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkViewBlocksReader* New();
  vtkTypeMacro(vtkViewBlocksReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The .vtm file to read.
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
  vtkViewBlocksReader();
  ~vtkViewBlocksReader() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;

private:
  vtkViewBlocksReader(const vtkViewBlocksReader&) = delete;
  void operator=(const vtkViewBlocksReader&) = delete;
};

#endif
