// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSimplifySurfaceFilter
 * @brief leave out a surface's vertices where it is flat, within a bound on the distance
 *
 * Edges are collapsed by CGAL's surface mesh simplification with the cost and placement of Lindstrom and
 * Turk ("Fast and memory efficient polygonal simplification", Visualization 1998). Each collapse is held
 * against the bound: no point of the result is further than Distance from the input, and none of the
 * input further from the result.
 *
 * Input: a vtkPolyData of triangles, closed or with borders, 2-manifold, consistently oriented. Output:
 * the same with fewer triangles, in the input's unit and precision. It is 2-manifold, and meets itself
 * nowhere if the input did not. Borders stay as they are. So do the borders between triangles that
 * differ in the cell arrays View or Kind (see vtkBisectionContourFilter), which the output has with the
 * values that the input has there. Other arrays are left out. It is the same for any number of threads.
 *
 * A Distance that is not above 0, cells that are no triangles, triangles that are no 2-manifold and
 * points that are not finite are an error, and the output is empty; so it is after an abort.
 */
#ifndef vtkSimplifySurfaceFilter_h
#define vtkSimplifySurfaceFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkSimplifySurfaceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkSimplifySurfaceFilter* New();
  vtkTypeMacro(vtkSimplifySurfaceFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The greatest distance between the two surfaces, either way, in the input's unit. Must be set:
   * default 0.
   */
  vtkSetMacro(Distance, double);
  vtkGetMacro(Distance, double);
  ///@}

protected:
  vtkSimplifySurfaceFilter() = default;
  ~vtkSimplifySurfaceFilter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Distance = 0.0;

private:
  vtkSimplifySurfaceFilter(const vtkSimplifySurfaceFilter&) = delete;
  void operator=(const vtkSimplifySurfaceFilter&) = delete;
};

#endif
