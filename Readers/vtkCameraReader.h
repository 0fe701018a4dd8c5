// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCameraReader
 * @brief read the cameras of a scene or of a structure-from-motion model
 *
 * FileName is a scene.json, the folder of a COLMAP model (cameras, images, points3D; .txt or .bin) or of a
 * bundle.out, or one of these files or a .nvm. The output has one block for each image, named after it: a
 * view without features, with the field data arrays CameraIntrinsics, CameraFromWorld, ImageSize and
 * ImageFile. Pixels follow COLMAP's convention; lens distortion is omitted.
 *
 * A file that cannot be read is an error that names it and the fault; the output is then empty.
 *
 * @sa vtkSparseModelReader vtkCalibratedCamera
 */
#ifndef vtkCameraReader_h
#define vtkCameraReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <string> // for FileName

class vtkPolyData;

class VTKFREESPACEREADERS_EXPORT vtkCameraReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCameraReader* New();
  vtkTypeMacro(vtkCameraReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A scene.json or the folder of a COLMAP model.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  /**
   * The block of an image in the output, or nullptr when the model does not have that image. Update
   * first. The extension of the image's name may be omitted where that is unambiguous.
   */
  vtkPolyData* GetView(const std::string& image);

protected:
  vtkCameraReader();
  ~vtkCameraReader() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;

private:
  vtkCameraReader(const vtkCameraReader&) = delete;
  void operator=(const vtkCameraReader&) = delete;
};

#endif
