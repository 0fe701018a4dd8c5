// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSimplifySurfaceFilter
 * @brief decimate a surface within a bound on the distance
 *
 * Collapses edges by CGAL's surface mesh simplification with the cost and placement of Lindstrom and Turk
 * ("Fast and memory efficient polygonal simplification", Visualization 1998). Each collapse is checked
 * against the bound: no point of the result is farther than Distance from the input, and no point of the
 * input is farther from the result.
 *
 * Input: a vtkPolyData of triangles, closed or with borders, 2-manifold, consistently oriented. Output:
 * the same with fewer triangles, in the unit and precision of the input. It is 2-manifold, and has no
 * self-intersection if the input has none. Borders are kept, and so are the borders between triangles that
 * differ in the cell arrays View or Kind (see vtkBisectionContourFilter); the output has these two arrays.
 * Other arrays are dropped. The result does not depend on the number of threads.
 *
 * A Distance that is not positive, cells that are not triangles, triangles that are not 2-manifold and
 * points that are not finite are errors, and the output is empty; after an abort it is empty, too.
 *
 * @sa vtkFitSurfaceFilter vtkSurfaceWriter
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
   * Maximum distance between the two surfaces, in both directions, in the input's unit. Must be set;
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
