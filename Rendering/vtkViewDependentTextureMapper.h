// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewDependentTextureMapper
 * @brief show a surface in the colours of photographs, chosen for the viewpoint
 *
 * What figure 12 of the paper is rendered with. For each fragment, of the photographs that see its
 * point of the surface those are blended that look at it most nearly as the renderer's camera does:
 * the penalty of a photograph is the angle between the two lines of sight (as a chord of the unit
 * sphere) and an addition where its pixels are coarser there, divided by the confidence in it. The
 * BlendedViews photographs of least penalty are mixed by weights that vanish at the penalty of the
 * next one, so that nothing jumps where the choice changes (the weights of the unstructured
 * lumigraph).
 *
 * Whether a photograph sees a point is told by a depth map of the surface from its camera, made
 * once for each surface; a photograph never colours what lies behind another part of the surface,
 * nor the back of what it saw from the front. Confidence falls towards occlusions and the
 * photograph's border within Feather pixels, which hides the seams. What no photograph sees has
 * UnseenColor.
 *
 * Photographs: the output of a vtkPhotographReader. All of them are used when the limits of the
 * OpenGL context, MaximumNumberOfViews and TextureMemory allow; otherwise those that matter most
 * for the current camera, see GetNumberOfViewsInUse. Photographs of a side beyond
 * MaximumPhotographSize, or the context's limit, are reduced to it. The surface is shown unlit. It
 * works in every OpenGL 3.2 context.
 *
 * A block that is not a photograph is an error that names it; the surface is then shown in
 * UnseenColor.
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
   * How many photographs are mixed in a fragment, 1 to 8. Default 4.
   */
  vtkSetClampMacro(BlendedViews, int, 1, 8);
  vtkGetMacro(BlendedViews, int);
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
   * How far behind the surface that a photograph sees a point still counts as seen, in sizes of the
   * photograph's pixel at that depth. Default 6.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1000.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Samples of a pixel that an edge of the surface crosses, 1 to 8, where the OpenGL context has as many.
   * Default 4.
   */
  vtkSetClampMacro(EdgeSamples, int, 1, 8);
  vtkGetMacro(EdgeSamples, int);
  ///@}

  ///@{
  /**
   * The most photographs that are held by the context at a time, 1 to 64. Default 64.
   */
  vtkSetClampMacro(MaximumNumberOfViews, int, 1, 64);
  vtkGetMacro(MaximumNumberOfViews, int);
  ///@}

  ///@{
  /**
   * Longest side of a photograph in the context, in pixels. Default 2048.
   */
  vtkSetClampMacro(MaximumPhotographSize, int, 16, 16384);
  vtkGetMacro(MaximumPhotographSize, int);
  ///@}

  ///@{
  /**
   * The most memory that photographs and depth maps may take in the context, in MiB. Default 1024.
   */
  vtkSetClampMacro(TextureMemory, int, 1, 1048576);
  vtkGetMacro(TextureMemory, int);
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
   * The photographs that the last rendering chose from, by the names of their blocks.
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
  double Feather = 12.0;
  double Tolerance = 6.0;
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
