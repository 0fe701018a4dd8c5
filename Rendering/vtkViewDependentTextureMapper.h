// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewDependentTextureMapper
 * @brief map images onto a surface, depending on the viewpoint
 *
 * Figure 12 of the paper is rendered this way. Each fragment blends those images that see its point
 * from a direction close to that of the renderer's camera. The penalty of an image is the angle
 * between the two lines of sight (as a chord of the unit sphere) plus a term for coarser pixels, divided
 * by its confidence. The BlendedViews images with the smallest penalties are blended with weights
 * that vanish at the penalty of the next one, so that the result is continuous (the weights of the
 * unstructured lumigraph).
 *
 * Visibility is decided by a depth map of the surface for each image, rendered once for each surface;
 * an image colours neither what is behind another part of the surface nor back faces. Confidence
 * decreases towards occlusions and the border of the image within Feather pixels, which hides seams.
 * Fragments that no image sees have UnseenColor.
 *
 * Images: the output of a vtkPhotographReader. All are used if the limits of the OpenGL context,
 * MaximumNumberOfViews and TextureMemory allow it; otherwise those that matter most for the current camera,
 * see GetNumberOfViewsInUse. Images larger than MaximumPhotographSize, or than the limit of the
 * context, are reduced. The surface is rendered unlit. Requires OpenGL 3.2.
 *
 * A block that is not an image is an error that names it; the surface is then rendered in UnseenColor.
 *
 * @sa vtkPhotographReader vtkSurfacePicture vtkTextureBaker
 *
 * @warning Images must have the exposure of each other: differences remain visible.
 */
#ifndef vtkViewDependentTextureMapper_h
#define vtkViewDependentTextureMapper_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkSmartPointer.h" // for Photographs

#include <memory> // for Internals
#include <string> // for GetViewInUse

class vtkMultiBlockDataSet;

class VTKFREESPACERENDERING_EXPORT vtkViewDependentTextureMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkViewDependentTextureMapper* New();
  vtkTypeMacro(vtkViewDependentTextureMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Blocks of vtkImageData with the field data of their cameras. Default: none.
   */
  virtual void SetPhotographs(vtkMultiBlockDataSet* photographs);
  vtkMultiBlockDataSet* GetPhotographs();
  ///@}

  ///@{
  /**
   * Number of images that are blended in a fragment, 1 to 8. Default 4.
   */
  vtkSetClampMacro(BlendedViews, int, 1, 8);
  vtkGetMacro(BlendedViews, int);
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
   * Tolerance of the depth test for visibility, in footprints of the image's pixel at that depth. Default 6.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1000.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Number of samples of pixels on the surface's edges, 1 to 8, as far as the OpenGL context supports it.
   * Default 4.
   */
  vtkSetClampMacro(EdgeSamples, int, 1, 8);
  vtkGetMacro(EdgeSamples, int);
  ///@}

  ///@{
  /**
   * Maximum number of images in the context at a time, 1 to 64. Default 64.
   */
  vtkSetClampMacro(MaximumNumberOfViews, int, 1, 64);
  vtkGetMacro(MaximumNumberOfViews, int);
  ///@}

  ///@{
  /**
   * Maximum side of an image in the context, pixels. Default 2048.
   */
  vtkSetClampMacro(MaximumPhotographSize, int, 16, 16384);
  vtkGetMacro(MaximumPhotographSize, int);
  ///@}

  ///@{
  /**
   * Limit of the memory for images and depth maps in the context, MiB. Default 1024.
   */
  vtkSetClampMacro(TextureMemory, int, 1, 1048576);
  vtkGetMacro(TextureMemory, int);
  ///@}

  ///@{
  /**
   * Red, green and blue, 0 to 1, of fragments that no image sees. Default 0.7 each.
   */
  vtkSetVector3Macro(UnseenColor, double);
  vtkGetVector3Macro(UnseenColor, double);
  ///@}

  ///@{
  /**
   * The images that the last rendering used, by the names of their blocks.
   */
  int GetNumberOfViewsInUse();
  std::string GetViewInUse(int index);
  ///@}

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkViewDependentTextureMapper();
  ~vtkViewDependentTextureMapper() override;

  void ReplaceShaderLight(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;

  vtkSmartPointer<vtkMultiBlockDataSet> Photographs;
  int BlendedViews = 4;
  double Feather; // this and Tolerance by default as in freespace::VisibilityOptions
  double Tolerance;
  int EdgeSamples = 4;
  int MaximumNumberOfViews = 64;
  int MaximumPhotographSize = 2048;
  int TextureMemory = 1024;
  double UnseenColor[3] = { 0.7, 0.7, 0.7 };

private:
  vtkViewDependentTextureMapper(const vtkViewDependentTextureMapper&) = delete;
  void operator=(const vtkViewDependentTextureMapper&) = delete;

  void UpdateTextures(vtkRenderer* renderer, vtkActor* actor);
  bool DrawGeometry(vtkRenderer* renderer, vtkActor* actor);
  void DrawColors(vtkActor* actor);

  struct InternalState;
  std::unique_ptr<InternalState> Internals;
};

#endif
