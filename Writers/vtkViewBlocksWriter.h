// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewBlocksWriter
 * @brief write features or disparity maps to a .vtm file
 *
 * Writes VTK's XML multi-block format: NAME.vtm and a folder NAME beside it with one .vtp per view. Both
 * are written to a temporary folder and renamed, the .vtm last. A folder that cannot be written is an
 * error that names the file; Write() then returns 0.
 *
 * @sa vtkViewBlocksReader vtkEdgeStereoReader vtkDelaunayDisparityFilter
 */
#ifndef vtkViewBlocksWriter_h
#define vtkViewBlocksWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkWriter.h"

#include <string> // for FileName

class VTKFREESPACEWRITERS_EXPORT vtkViewBlocksWriter : public vtkWriter
{
public:
  static vtkViewBlocksWriter* New();
  vtkTypeMacro(vtkViewBlocksWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write, ending in .vtm.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Whether each .vtp has its arrays inline, as text, and not appended as bytes: larger, for programs that cannot read the
   * latter, such as ParaView 5.11 with the libexpat of Debian 12. Default off.
   */
  vtkSetMacro(InlineArrays, vtkTypeBool);
  vtkGetMacro(InlineArrays, vtkTypeBool);
  vtkBooleanMacro(InlineArrays, vtkTypeBool);
  ///@}

protected:
  vtkViewBlocksWriter() = default;
  ~vtkViewBlocksWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;
  vtkTypeBool InlineArrays = false;

private:
  vtkViewBlocksWriter(const vtkViewBlocksWriter&) = delete;
  void operator=(const vtkViewBlocksWriter&) = delete;
};

#endif
