// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkAppendPiecesFilter
 * @brief join the pieces of a surface
 *
 * vtkBisectionContourFilter generates a surface in pieces when a pipeline requests them, in several
 * processes or one after the other. This filter joins them: the points, triangles and cell arrays are
 * identical, in order and to the last bit, to those of the contour that is generated as a whole.
 *
 * Input: the pieces in their order, any number of vtkPolyData of triangles on one port
 * (AddInputConnection or AddInputData). Points that the point array vtkGhostType marks as duplicates
 * belong to another piece and are found there by their coordinates, which are identical. A marked point
 * that no other piece has is kept. Output: the whole surface, without that array.
 *
 * Pieces of different precision, cells that are not triangles, and more than 2^31 corners are errors, and
 * the output is empty.
 *
 * @sa vtkBisectionContourFilter vtkFitSurfaceFilter
 */
#ifndef vtkAppendPiecesFilter_h
#define vtkAppendPiecesFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkAppendPiecesFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkAppendPiecesFilter* New();
  vtkTypeMacro(vtkAppendPiecesFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Keep only observed triangles, as vtkBisectionContourFilter::SetObservedOnly does. To be set here, not
   * there, for the same result as that of the whole surface. Default off.
   */
  vtkSetMacro(ObservedOnly, vtkTypeBool);
  vtkGetMacro(ObservedOnly, vtkTypeBool);
  vtkBooleanMacro(ObservedOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Keep connected components without supporting features, as vtkBisectionContourFilter::SetCrumbs does; that
   * filter keeps them in pieces. Default off.
   */
  vtkSetMacro(Crumbs, vtkTypeBool);
  vtkGetMacro(Crumbs, vtkTypeBool);
  vtkBooleanMacro(Crumbs, vtkTypeBool);
  ///@}

  /**
   * After Update(): the number of triangles that were dropped because Crumbs is off.
   */
  vtkGetMacro(CrumbTriangles, vtkIdType);

protected:
  vtkAppendPiecesFilter();
  ~vtkAppendPiecesFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  // Defaults are those of freespace::TriangleSelection.
  vtkTypeBool ObservedOnly;
  vtkTypeBool Crumbs;
  vtkIdType CrumbTriangles = 0;

private:
  vtkAppendPiecesFilter(const vtkAppendPiecesFilter&) = delete;
  void operator=(const vtkAppendPiecesFilter&) = delete;
};

#endif
