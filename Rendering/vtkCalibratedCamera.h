// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCalibratedCamera
 * @brief make a vtkCamera see what a calibrated camera saw
 *
 * A window of the image's size (or of its proportions) then shows each point of space at the pixel
 * where the calibrated camera has it: unequal focal lengths, skew and a principal point off the
 * centre are all kept. The camera looks along +z, x right and y down, `x_cam = R x_world + t`; the
 * centre of the image's first pixel is (0.5, 0.5), and so is that of the window's top left pixel.
 * What was set up in the vtkCamera before is replaced, but for its clipping range.
 *
 * A camera that is not one (values that are not finite, a matrix that is no rotation, a focal
 * length or a size that is not positive) is an error: 0 is returned and the vtkCamera is left as it
 * was.
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
