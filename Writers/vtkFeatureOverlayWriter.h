// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFeatureOverlayWriter
 * @brief draw the features of each view over its image
 *
 * Writes one PNG for each view of the input, named after the view, to OutputFolder: the reference image,
 * darkened, with the features of the view, coloured by disparity from blue (far) to red (near), and its
 * lines. Figure 8 of the paper.
 *
 * Input: a vtkMultiBlockDataSet of features, as vtkEdgeStereoReader generates it. Features are drawn where
 * a camera without distortion sees them, so they are off by the distortion of an image's lens.
 *
 * An image that cannot be read or whose size is not that of the view, a folder that cannot be written and
 * a block that is not a view are errors that name it; Write() then returns 0. Each file is written beside
 * its target and renamed.
 *
 * @sa vtkEdgeStereoReader
 */
#ifndef vtkFeatureOverlayWriter_h
#define vtkFeatureOverlayWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkWriter.h"

#include <string> // for the folders

class VTKFREESPACEWRITERS_EXPORT vtkFeatureOverlayWriter : public vtkWriter
{
public:
  static vtkFeatureOverlayWriter* New();
  vtkTypeMacro(vtkFeatureOverlayWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to which the views' ImageFile is relative.
   */
  vtkSetFilePathStringMacro(ImagesFolder);
  vtkGetFilePathStringMacro(ImagesFolder);
  ///@}

  ///@{
  /**
   * The folder for the images; created if it is missing.
   */
  vtkSetFilePathStringMacro(OutputFolder);
  vtkGetFilePathStringMacro(OutputFolder);
  ///@}

protected:
  vtkFeatureOverlayWriter() = default;
  ~vtkFeatureOverlayWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string ImagesFolder;
  std::string OutputFolder;

private:
  vtkFeatureOverlayWriter(const vtkFeatureOverlayWriter&) = delete;
  void operator=(const vtkFeatureOverlayWriter&) = delete;
};

#endif
