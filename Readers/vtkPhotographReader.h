// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPhotographReader
 * @brief read the images of a scene, with their cameras
 *
 * Reads a scene.json, its camera model and its images. Output: a vtkMultiBlockDataSet with one vtkImageData
 * (three unsigned chars, the bottom row first as in VTK) for each image of the model whose file exists,
 * named after it, with the field data CameraIntrinsics, CameraFromWorld, ImageSize and ImageFile of the
 * views (see the README). Lens distortion is removed from the images.
 *
 * An image without a file is skipped, since a model can contain more images than were kept. A scene without
 * any image, and an image that is damaged or whose size is not that of its camera, are errors that name it;
 * the output is then empty.
 *
 * @sa vtkTextureBaker vtkViewDependentTextureMapper vtkEdgeStereoReader
 */
#ifndef vtkPhotographReader_h
#define vtkPhotographReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <string> // for FileName

class VTKFREESPACEREADERS_EXPORT vtkPhotographReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkPhotographReader* New();
  vtkTypeMacro(vtkPhotographReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene.json.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

protected:
  vtkPhotographReader();
  ~vtkPhotographReader() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;

private:
  vtkPhotographReader(const vtkPhotographReader&) = delete;
  void operator=(const vtkPhotographReader&) = delete;
};

#endif
