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
#include "vtkFreespaceSetGet.h"        // for file names
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
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
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
