// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkAppendPiecesFilter
 * @brief put the pieces of a surface together to the whole, exactly
 *
 * vtkBisectionContourFilter makes a surface in pieces where a pipeline asks for them, in several
 * processes or one after the other. This filter joins them: points, triangles and cell arrays are those,
 * in the same order and to the last bit, that the contour has when it is made whole.
 *
 * Input: the pieces, any number of vtkPolyData of triangles on one port (AddInputConnection or
 * AddInputData), in their order. Points that the point array vtkGhostType marks as duplicates belong to
 * another piece: they are found there by their coordinates, which are exactly the same. A marked point
 * that no other piece has is kept as the piece's own. Output: the whole surface, without that array.
 *
 * Pieces whose points differ in precision, cells that are no triangles, and more than 2^31 corners are
 * an error, and the output is empty.
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
   * Keep only what was seen, like vtkBisectionContourFilter's setting of that name: to be set here, not
   * there, when the result is to be the same as that of the whole. Default off.
   */
  vtkSetMacro(ObservedOnly, vtkTypeBool);
  vtkGetMacro(ObservedOnly, vtkTypeBool);
  vtkBooleanMacro(ObservedOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Keep connected components that no feature supports, like vtkBisectionContourFilter's setting of that name,
   * which leaves them to this filter where it makes pieces. Default off.
   */
  vtkSetMacro(Crumbs, vtkTypeBool);
  vtkGetMacro(Crumbs, vtkTypeBool);
  vtkBooleanMacro(Crumbs, vtkTypeBool);
  ///@}

protected:
  vtkAppendPiecesFilter();
  ~vtkAppendPiecesFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  // Defaults are those of freespace::TriangleSelection.
  vtkTypeBool ObservedOnly;
  vtkTypeBool Crumbs;

private:
  vtkAppendPiecesFilter(const vtkAppendPiecesFilter&) = delete;
  void operator=(const vtkAppendPiecesFilter&) = delete;
};

#endif
