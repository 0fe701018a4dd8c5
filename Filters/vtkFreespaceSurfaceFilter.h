// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFreespaceSurfaceFilter
 * @brief disparity maps to the surface, in one pipeline filter
 *
 * The union of the views' free spaces (vtkFreespaceUnion), its boundary (vtkBisectionContourFilter) and the
 * fit of that to the features (vtkFitSurfaceFilter), so that `maps -> surface -> writer` is a pipeline of
 * connections. Its result is that of the program's `contour`. For Phi itself, as cutters and queries need
 * it, use vtkFreespaceUnion.
 *
 * Input: a vtkMultiBlockDataSet of disparity maps, as vtkDelaunayDisparityFilter makes it. Output: a
 * vtkPolyData of triangles with the arrays of vtkBisectionContourFilter. Settings that are not repeated
 * here are those of the three classes: GetFreespaceUnion, GetContour and GetFit. The maps are released when
 * the surface is made. Pieces, progress, abort and errors are those of vtkBisectionContourFilter; a piece of
 * the surface is not fitted.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, section 2.2.
 *
 * @sa vtkDelaunayDisparityFilter vtkFreespaceUnion vtkBisectionContourFilter vtkSurfaceWriter
 *
 * @warning The free space theorem needs edges wherever a surface ends. A smooth surface without texture is
 * cut to the polyhedron of its features.
 */
#ifndef vtkFreespaceSurfaceFilter_h
#define vtkFreespaceSurfaceFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkNew.h"                    // for the two classes
#include "vtkPolyDataAlgorithm.h"

class vtkBisectionContourFilter;
class vtkFitSurfaceFilter;
class vtkFreespaceUnion;

class VTKFREESPACEFILTERS_EXPORT vtkFreespaceSurfaceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkFreespaceSurfaceFilter* New();
  vtkTypeMacro(vtkFreespaceSurfaceFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What does the work, with all its settings. Do not give them other maps or another function.
   */
  vtkFreespaceUnion* GetFreespaceUnion();
  vtkBisectionContourFilter* GetContour();
  vtkFitSurfaceFilter* GetFit();
  ///@}

  ///@{
  /**
   * Whether the surface's vertices move to where all features together say that it is. Off is the paper.
   * Default on.
   */
  vtkSetMacro(FitSurface, vtkTypeBool);
  vtkGetMacro(FitSurface, vtkTypeBool);
  vtkBooleanMacro(FitSurface, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How many cells the lattice has along the longest side of the region; 0, the default, takes as many as
   * show what the features tell. See vtkBisectionContourFilter::SetCells.
   */
  void SetCells(int cells);
  int GetCells();
  ///@}

  ///@{
  /**
   * By how much the hull is pushed out, as a fraction of the diagonal of the region's features; -1, the
   * default, is somewhat more than a cell of the lattice. See vtkFreespaceUnion::SetHullMargin.
   */
  vtkSetMacro(HullMargin, double);
  vtkGetMacro(HullMargin, double);
  ///@}

  ///@{
  /**
   * So many views must agree that a point is free; -1, the default, is 1 or 2 by how often views contradict
   * each other. 1 is the paper. See vtkFreespaceUnion::SetMinimumViews.
   */
  void SetMinimumViews(int views);
  int GetMinimumViews();
  ///@}

  /**
   * Covers the three classes' settings.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkFreespaceSurfaceFilter();
  ~vtkFreespaceSurfaceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkFreespaceSurfaceFilter(const vtkFreespaceSurfaceFilter&) = delete;
  void operator=(const vtkFreespaceSurfaceFilter&) = delete;

  vtkNew<vtkFreespaceUnion> FreespaceUnion;
  vtkMTimeType TimeOfSettings();

  vtkNew<vtkBisectionContourFilter> Contour;
  vtkNew<vtkFitSurfaceFilter> Fit;
  vtkTypeBool FitSurface = true;
  double HullMargin = -1.0;
  vtkMTimeType InnerTime = 0; ///< of the classes' settings, without the data that come and go
};

#endif
