// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTextureBaker
 * @brief bake a texture for a surface from images
 *
 * Input: a vtkPolyData of triangles. Output port 0: the surface with texture coordinates and with the point
 * scalars "RGB", the colours of its points; points are duplicated for each chart that contains them. Output
 * port 1: the texture, a vtkImageData of three unsigned chars whose first row is v = 0.
 *
 * The surface is cut into charts, each projected along a coordinate axis, which are packed into one image.
 * Each texel is a weighted mean over all images that see it (by a depth map for each); the image
 * that views it most frontally and closely has by far the greatest weight. The weights decrease towards
 * occlusions and borders, and differences of exposure are levelled, so that neither charts nor images
 * leave seams. Texels that no image sees are filled from their surroundings in the chart, or with
 * UnseenColor. The texture assumes diffuse reflection, since it does not depend on the viewpoint.
 *
 * Missing images or an empty surface are errors; the output is then empty.
 *
 * @sa vtkPhotographReader vtkTexturedSurfaceWriter vtkViewDependentTextureMapper
 */
#ifndef vtkTextureBaker_h
#define vtkTextureBaker_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for Photographs

class vtkImageData;
class vtkMultiBlockDataSet;

class VTKFREESPACERENDERING_EXPORT vtkTextureBaker : public vtkPolyDataAlgorithm
{
public:
  static vtkTextureBaker* New();
  vtkTypeMacro(vtkTextureBaker, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The output of a vtkPhotographReader. Default: none.
   */
  virtual void SetPhotographs(vtkMultiBlockDataSet* photographs);
  vtkMultiBlockDataSet* GetPhotographs();
  ///@}

  /**
   * The texture, output port 1.
   */
  vtkImageData* GetTexture();

  ///@{
  /**
   * Side of a texel in the unit of the surface. Default 0: the median footprint of the images' pixels
   * on the surface, or larger if the texture would exceed LargestTexture. A given size that is too small for
   * LargestTexture is an error that names the minimum.
   */
  vtkSetClampMacro(TexelSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TexelSize, double);
  ///@}

  ///@{
  /**
   * Maximum side of the texture in texels. Default 8192.
   */
  vtkSetClampMacro(LargestTexture, int, 16, 32768);
  vtkGetMacro(LargestTexture, int);
  ///@}

  ///@{
  /**
   * Limit of the memory for the images and the texture, MiB; 0, the default, is none. Texels become larger until the
   * texture fits; where TexelSize is given, or the images alone do not fit, it is an error with an estimate.
   */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /**
   * Exponent of the weights (confidence, incidence and resolution): how far the best image dominates.
   * Default 4.
   */
  vtkSetClampMacro(Sharpness, double, 0.0, 100.0);
  vtkGetMacro(Sharpness, double);
  ///@}

  ///@{
  /**
   * Whether differences of exposure between images are levelled. Default on.
   */
  vtkSetMacro(Leveling, vtkTypeBool);
  vtkGetMacro(Leveling, vtkTypeBool);
  vtkBooleanMacro(Leveling, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Distance from an occlusion or the border of an image to full confidence, pixels; at least 1. Default 12.
   */
  vtkSetClampMacro(Feather, double, 1.0, 1000.0);
  vtkGetMacro(Feather, double);
  ///@}

  ///@{
  /**
   * Red, green and blue, 0 to 1, of texels that no image sees. Default 0.7 each.
   */
  vtkSetVector3Macro(UnseenColor, double);
  vtkGetVector3Macro(UnseenColor, double);
  ///@}

  ///@{
  /**
   * Number of charts of the last texture, and the side of its texels.
   */
  vtkGetMacro(NumberOfCharts, int);
  vtkGetMacro(BakedTexelSize, double);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkTextureBaker();
  ~vtkTextureBaker() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkSmartPointer<vtkMultiBlockDataSet> Photographs;
  // Defaults are those of freespace::TextureAtlasOptions and SurfaceColorOptions.
  double TexelSize;
  int LargestTexture;
  double MemoryLimit;
  double Sharpness;
  vtkTypeBool Leveling;
  double Feather;
  double UnseenColor[3] = { 0.7, 0.7, 0.7 };
  int NumberOfCharts = 0;
  double BakedTexelSize = 0.0;

private:
  vtkTextureBaker(const vtkTextureBaker&) = delete;
  void operator=(const vtkTextureBaker&) = delete;
};

#endif
