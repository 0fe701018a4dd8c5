// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPhotographReader
 * @brief read the photographs of a scene, with their cameras
 *
 * Reads a scene.json, its camera model and its images. Output: a vtkMultiBlockDataSet of one
 * vtkImageData (three unsigned chars, the bottom row first as VTK has it) for each image of the
 * model whose file exists, named after it, with the field data CameraIntrinsics, CameraFromWorld,
 * ImageSize and ImageFile of the views (see the README). A lens's distortion is taken out of the
 * image.
 *
 * An image without a file is left out: a model may hold more images than were kept. A scene without
 * any image, or an image that is damaged or not of its camera's size, is an error that names it;
 * the output is then empty.
 */
#ifndef vtkPhotographReader_h
#define vtkPhotographReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
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
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
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
