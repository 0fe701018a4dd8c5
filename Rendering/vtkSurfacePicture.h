// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfacePicture
 * @brief a picture of a surface, as a calibrated camera or a passer-by would see it
 *
 * Input: a vtkPolyData. Output: a vtkImageData of three unsigned chars, the first row at the bottom
 * as VTK has it. The surface is shown in a neutral grey under two lights that move with the camera,
 * facet by facet, its inside in a warmer tone, on a light background; where it has colours
 * (unsigned char point or cell scalars) they are shown. A mapper of one's own, for instance a
 * vtkViewDependentTextureMapper, is shown as it is, without lights.
 *
 * SetView or SetViewBlock choose a calibrated camera (see vtkCalibratedCamera) and its image size.
 * Without one the picture is of Size: from the viewpoint that the surface knows (a camera in its field
 * data, as the program's surfaces have it in .ply and .vtp), or else of the whole from Azimuth and
 * Elevation, +z up.
 * Each pixel is the mean of Samples x Samples rays.
 *
 * The window lives on between updates: a second picture of the same surface costs little. An empty
 * surface, or a camera that is not one, is an error; the output is then empty.
 */
#ifndef vtkSurfacePicture_h
#define vtkSurfacePicture_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for Mapper

#include <memory> // for Scene
#include <string> // for WritePNG

class vtkPolyData;
class vtkPolyDataMapper;

class VTKFREESPACERENDERING_EXPORT vtkSurfacePicture : public vtkImageAlgorithm
{
public:
  static vtkSurfacePicture* New();
  vtkTypeMacro(vtkSurfacePicture, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Look from a calibrated camera, given as arrays (K and [R t] row-major, width and height) or by
   * the field data of a view's block. Default: none. NoView goes back to the default viewpoint.
   */
  void SetView(
    const double intrinsics[9], const double cameraFromWorld[12], const int imageSize[2]);
  void SetViewBlock(vtkPolyData* block);
  void NoView();
  ///@}

  ///@{
  /**
   * Width and height in pixels of a picture without a view. Default 1280 x 960.
   */
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{
  /**
   * Whether a picture without a view is taken from the surface's own viewpoint, where it has one. Default on.
   */
  vtkSetMacro(UseViewpoint, vtkTypeBool);
  vtkGetMacro(UseViewpoint, vtkTypeBool);
  vtkBooleanMacro(UseViewpoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Otherwise, where a picture without a view is taken from, in degrees: the azimuth from +x towards +y around the
   * surface, the elevation above the plane of x and y, -90 to 90. Defaults -123 and 33: obliquely from above.
   */
  vtkSetMacro(Azimuth, double);
  vtkGetMacro(Azimuth, double);
  vtkSetClampMacro(Elevation, double, -90.0, 90.0);
  vtkGetMacro(Elevation, double);
  ///@}

  ///@{
  /**
   * Side of the square of rays whose mean makes a pixel, 1 to 8. Default 2. It is lowered where the
   * picture would be larger than 8192 pixels before the mean is taken.
   */
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * Red, green and blue of the background, 0 to 1. Default white.
   */
  vtkSetVector3Macro(Background, double);
  vtkGetVector3Macro(Background, double);
  ///@}

  ///@{
  /**
   * What shows the surface; it is given the input. Default: none, for the grey look.
   */
  virtual void SetMapper(vtkPolyDataMapper* mapper);
  vtkPolyDataMapper* GetMapper();
  ///@}

  /**
   * Brings the picture up to date and writes it. The file is written beside its target and renamed;
   * a file that cannot be written is an error that names it. Returns 1, or 0 after an error.
   */
  int WritePNG(const std::string& fileName);

  vtkMTimeType GetMTime() override;

protected:
  vtkSurfacePicture();
  ~vtkSurfacePicture() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Size[2] = { 1280, 960 };
  vtkTypeBool UseViewpoint = true;
  double Azimuth = -123.0;
  double Elevation = 33.0;
  int Samples = 2;
  double Background[3] = { 1.0, 1.0, 1.0 };
  vtkSmartPointer<vtkPolyDataMapper> Mapper;

private:
  vtkSurfacePicture(const vtkSurfacePicture&) = delete;
  void operator=(const vtkSurfacePicture&) = delete;

  bool Check(vtkPolyData* surface, int width, int height);
  void PlaceCamera(vtkPolyData* surface, int width, int height);

  struct Stage;
  std::unique_ptr<Stage> Shown;
};

#endif
