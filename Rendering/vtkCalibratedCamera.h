// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCalibratedCamera
 * @brief set a vtkCamera to a calibrated camera
 *
 * In a window of the image's size, or of its aspect ratio, each point of space then appears at the pixel
 * where the calibrated camera projects it: unequal focal lengths, skew and an off-centre principal point
 * are all reproduced. The camera looks along +z, with x to the right and y down, `x_cam = R x_world + t`;
 * the centre of the image's first pixel is (0.5, 0.5), and so is that of the window's top left pixel. All
 * settings of the vtkCamera are replaced, except its clipping range.
 *
 * An invalid camera (values that are not finite, a matrix that is not a rotation, a focal length or a size
 * that is not positive) is an error: 0 is returned and the vtkCamera is unchanged.
 *
 * @sa vtkCameraReader vtkSurfacePicture vtkViewDependentTextureMapper
 */
#ifndef vtkCalibratedCamera_h
#define vtkCalibratedCamera_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkObject.h"

class vtkCamera;
class vtkPolyData;

class VTKFREESPACERENDERING_EXPORT vtkCalibratedCamera : public vtkObject
{
public:
  static vtkCalibratedCamera* New();
  vtkTypeMacro(vtkCalibratedCamera, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The intrinsics K and the pose [R t] are row-major as in a view's field data; the size is width
   * and height in pixels.
   */
  static int Apply(vtkCamera* camera, const double intrinsics[9], const double cameraFromWorld[12],
    const int imageSize[2]);

  /**
   * The same from the field data of a view's block: CameraIntrinsics, CameraFromWorld, ImageSize.
   */
  static int ApplyViewBlock(vtkCamera* camera, vtkPolyData* block);

protected:
  vtkCalibratedCamera() = default;
  ~vtkCalibratedCamera() override = default;

private:
  vtkCalibratedCamera(const vtkCalibratedCamera&) = delete;
  void operator=(const vtkCalibratedCamera&) = delete;
};

#endif
