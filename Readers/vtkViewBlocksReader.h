// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewBlocksReader
 * @brief read features or disparity maps from a .vtm file
 *
 * The counterpart of vtkViewBlocksWriter. Unlike vtkXMLMultiBlockDataReader it does not accept what it
 * could not read whole: a missing or truncated file, a missing block, a block without its arrays or
 * with a camera that cannot be used is an error that names the file and the view, and leaves the
 * output empty.
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
  vtkSetMacro(FileName, std::string);
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
