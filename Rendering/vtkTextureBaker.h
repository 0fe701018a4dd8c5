// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTextureBaker
 * @brief give a surface a texture made of photographs, once and for all viewpoints
 *
 * Input: a vtkPolyData of triangles. Output port 0: the surface with texture coordinates and, as point
 * scalars "RGB", the colours of its points; points are repeated for each chart that they are in. Output
 * port 1: the texture, a vtkImageData of three unsigned chars whose first row is v = 0.
 *
 * The surface is cut into charts, each seen along an axis of space, packed into one image and coloured
 * from all photographs that see it (by a depth map for each), the best one, which looks at it squarely and
 * from near, counting by far the most. The weights fade towards occlusions and borders, and
 * differences of exposure are levelled, so that neither charts nor photographs leave a seam. What no
 * photograph sees takes the colours around it within a chart, UnseenColor elsewhere. The surface is
 * taken as it would look in diffuse light: a baked texture knows no viewpoint.
 *
 * Photographs that are none, or an empty surface, are an error; the output is then empty.
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
   * Side of a texel in the unit of the surface. Default 0: the median size of the photographs' pixels on
   * the surface, or larger where the texture would exceed LargestTexture. One that is given and too small for
   * that is an error that tells what fits.
   */
  vtkSetClampMacro(TexelSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TexelSize, double);
  ///@}

  ///@{
  /**
   * The texture's longest side in texels. Default 8192.
   */
  vtkSetClampMacro(LargestTexture, int, 16, 32768);
  vtkGetMacro(LargestTexture, int);
  ///@}

  ///@{
  /**
   * How much the best photograph outweighs the others: a power of confidence, incidence and resolution.
   * Default 4.
   */
  vtkSetClampMacro(Sharpness, double, 0.0, 100.0);
  vtkGetMacro(Sharpness, double);
  ///@}

  ///@{
  /**
   * Whether differences of exposure between photographs are evened out. Default on.
   */
  vtkSetMacro(Leveling, vtkTypeBool);
  vtkGetMacro(Leveling, vtkTypeBool);
  vtkBooleanMacro(Leveling, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Pixels from an occlusion or the photograph's border to full confidence, at least 1. Default 12.
   */
  vtkSetClampMacro(Feather, double, 1.0, 1000.0);
  vtkGetMacro(Feather, double);
  ///@}

  ///@{
  /**
   * Red, green and blue, 0 to 1, of what no photograph sees. Default 0.7 each.
   */
  vtkSetVector3Macro(UnseenColor, double);
  vtkGetVector3Macro(UnseenColor, double);
  ///@}

  ///@{
  /**
   * How many charts the last texture has, and the side of its texels.
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
  double TexelSize = 0.0;
  int LargestTexture = 8192;
  double Sharpness = 4.0;
  vtkTypeBool Leveling = true;
  double Feather = 12.0;
  double UnseenColor[3] = { 0.7, 0.7, 0.7 };
  int NumberOfCharts = 0;
  double BakedTexelSize = 0.0;

private:
  vtkTextureBaker(const vtkTextureBaker&) = delete;
  void operator=(const vtkTextureBaker&) = delete;
};

#endif
