// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFreespaceSurfaceFilter
 * @brief disparity maps to the surface, in one pipeline filter
 *
 * Combines the union of the views' free spaces (vtkFreespaceUnion), its boundary
 * (vtkBisectionContourFilter) and the fit of the boundary to the features (vtkFitSurfaceFilter), so that
 * `maps -> surface -> writer` is a pipeline of connections. The result is that of the program's `contour`.
 * For Phi itself, for cutters and queries, use vtkFreespaceUnion.
 *
 * Input: a vtkMultiBlockDataSet of disparity maps, as vtkDelaunayDisparityFilter makes it. Output: a
 * vtkPolyData of triangles with the arrays of vtkBisectionContourFilter. Further settings are those
 * of the three classes: GetFreespaceUnion, GetContour and GetFit. The maps are released after execution.
 * Pieces, progress, abort and errors are those of vtkBisectionContourFilter; pieces are not fitted.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, section 2.2.
 *
 * @sa vtkDelaunayDisparityFilter vtkFreespaceUnion vtkBisectionContourFilter vtkSurfaceWriter
 *
 * @warning Free space is valid only if features lie on every depth discontinuity. A smooth surface without
 * texture is cut down to the polyhedron of its features.
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
   * The internal classes, for their settings. Do not give them other maps or another function.
   */
  vtkFreespaceUnion* GetFreespaceUnion();
  vtkBisectionContourFilter* GetContour();
  vtkFitSurfaceFilter* GetFit();
  ///@}

  ///@{
  /**
   * Whether the vertices are fitted to the features of all views. Off in the paper. Default on.
   */
  vtkSetMacro(FitSurface, vtkTypeBool);
  vtkGetMacro(FitSurface, vtkTypeBool);
  vtkBooleanMacro(FitSurface, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Number of lattice cells along the longest side; -1, the default, is automatic. See
   * vtkBisectionContourFilter::SetCells.
   */
  void SetCells(int cells);
  int GetCells();
  ///@}

  ///@{
  /**
   * Offset of the hull, as a fraction of the diagonal of the box of the features; -1, the default, is
   * slightly more than a lattice cell, or than the distance of the features where they are sparse. See vtkFreespaceUnion::SetHullMargin.
   */
  vtkSetMacro(HullMargin, double);
  vtkGetMacro(HullMargin, double);
  ///@}

  ///@{
  /**
   * Number of views in whose free space a point must be to be free; -1, the default, is automatic; 1 in the
   * paper. See vtkFreespaceUnion::SetMinimumViews.
   */
  void SetMinimumViews(int views);
  int GetMinimumViews();
  ///@}

  /**
   * Includes the settings of the three classes.
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
