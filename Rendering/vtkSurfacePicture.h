// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfacePicture
 * @brief render a surface to an image
 *
 * Input: a vtkPolyData. Output: a vtkImageData of three unsigned chars. The surface is rendered in a
 * neutral grey with flat shading and two lights that move with the camera, its back faces in a warmer
 * tone, on a light background; colours (unsigned char point or cell scalars) are used where it has them. A
 * mapper that is set, for instance a vtkViewDependentTextureMapper, is rendered without lights.
 *
 * SetView or SetViewBlock choose a calibrated camera (see vtkCalibratedCamera) and its image size.
 * Otherwise the image has the size Size, and the viewpoint is that stored with the surface (a camera in
 * its field data, as the program writes it to .ply and .vtp), or else Azimuth and Elevation, with Up upwards
 * and all of the surface in sight. Each pixel is the mean of Samples x Samples rays.
 *
 * The window is kept between updates, so that a second image of the same surface is cheap. An empty
 * surface or an invalid camera is an error; the output is then empty.
 *
 * @sa vtkCalibratedCamera vtkViewDependentTextureMapper vtkSurfaceReader
 */
#ifndef vtkSurfacePicture_h
#define vtkSurfacePicture_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for Mapper

#include <memory> // for Scene
#include <string> // for ColorArray

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
   * Use a calibrated camera, given as arrays (K and [R t] row-major, width and height) or by the field data
   * of a view's block. Default: none. NoView restores the default viewpoint.
   */
  void SetView(
    const double intrinsics[9], const double cameraFromWorld[12], const int imageSize[2]);
  void SetViewBlock(vtkPolyData* block);
  void NoView();
  ///@}

  ///@{
  /**
   * Width and height in pixels of an image without a view. Default 1280 x 960.
   */
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{
  /**
   * Whether an image without a view uses the viewpoint that is stored with the surface, if any. Default on.
   */
  vtkSetMacro(UseViewpoint, vtkTypeBool);
  vtkGetMacro(UseViewpoint, vtkTypeBool);
  vtkBooleanMacro(UseViewpoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Viewpoint of an image without a view and without a stored viewpoint, in degrees: the azimuth from +x
   * towards +y, the elevation above the xy plane, -90 to 90. Defaults -123 and 33.
   */
  vtkSetMacro(Azimuth, double);
  vtkGetMacro(Azimuth, double);
  vtkSetClampMacro(Elevation, double, -90.0, 90.0);
  vtkGetMacro(Elevation, double);
  ///@}

  ///@{
  /**
   * What is up where azimuth and elevation tell the viewpoint; of any length but 0. Default +z. Azimuth 0 is
   * +x turned with it.
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * How many times larger than the viewpoint, or the view, has it the middle of the picture is shown, above 0.
   * Default 1.
   */
  vtkSetMacro(Zoom, double);
  vtkGetMacro(Zoom, double);
  ///@}

  ///@{
  /**
   * Whether the edges of the triangles are drawn. Default off.
   */
  vtkSetMacro(Edges, vtkTypeBool);
  vtkGetMacro(Edges, vtkTypeBool);
  vtkBooleanMacro(Edges, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The point or cell data array that colours the grey look, with a bar that tells its range; one that is not
   * there is an error. Of several components their length. The bar's words need VTK::RenderingFreeType among the
   * modules that vtk_module_autoinit names; Python has it. Default: none.
   */
  vtkSetMacro(ColorArray, std::string);
  vtkGetMacro(ColorArray, std::string);
  ///@}

  ///@{
  /**
   * Each pixel is the mean of Samples x Samples rays, 1 to 8. Default 2. It is reduced if the image would
   * otherwise be rendered at more than 8192 pixels along a side.
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
   * The mapper of the surface, which receives the input. Default: none, for the neutral grey.
   */
  virtual void SetMapper(vtkPolyDataMapper* mapper);
  vtkPolyDataMapper* GetMapper();
  ///@}

  /**
   * Updates the image and writes it. The file is written beside its target and renamed;
   * a file that cannot be written is an error that names it. Returns 1, or 0 after an error.
   */
  int WritePNG(VTK_FILEPATH const std::string& fileName);

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
  double Up[3] = { 0.0, 0.0, 1.0 };
  double Zoom = 1.0;
  vtkTypeBool Edges = false;
  std::string ColorArray;
  vtkSmartPointer<vtkPolyDataMapper> Mapper;

private:
  vtkSurfacePicture(const vtkSurfacePicture&) = delete;
  void operator=(const vtkSurfacePicture&) = delete;

  bool Check(vtkPolyData* surface, int width, int height);
  bool ShowColors(vtkPolyData* surface);
  void PlaceCamera(vtkPolyData* surface, int width, int height);

  struct Stage;
  std::unique_ptr<Stage> Shown;
};

#endif
