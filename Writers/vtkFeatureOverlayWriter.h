// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFeatureOverlayWriter
 * @brief draw the features of each view over its picture
 *
 * For each view of the input one PNG, named after the view, in OutputFolder: the reference picture,
 * darkened, with the view's features over it, coloured by disparity from blue (far) to red (near), the
 * lines between them drawn as such. Figure 8 of the paper.
 *
 * Input: a vtkMultiBlockDataSet of features, as vtkEdgeStereoReader gives it. Features are where a
 * camera without distortion sees them: over a picture with lens distortion they are off by as much.
 *
 * A picture that cannot be read or has not the size that the view tells, a folder that cannot be
 * written or a block that is not a view is an error that names it; Write() then returns 0. Each picture
 * is written beside its target and renamed.
 */
#ifndef vtkFeatureOverlayWriter_h
#define vtkFeatureOverlayWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
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
  vtkSetMacro(ImagesFolder, std::string);
  vtkGetMacro(ImagesFolder, std::string);
  ///@}

  ///@{
  /**
   * Where the pictures go; made when it is missing.
   */
  vtkSetMacro(OutputFolder, std::string);
  vtkGetMacro(OutputFolder, std::string);
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
