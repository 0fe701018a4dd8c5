// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFitSurfaceFilter
 * @brief fit the vertices of a surface to the features of all views
 *
 * The union of free spaces follows the deepest of the disparity maps, and each map interpolates the noise
 * of its features. This filter moves the vertices so that the surface is smooth except at sharp edges and
 * fits the features of all views in a robust least squares sense; see freespace::FitSurface.
 *
 * Input 0: a vtkPolyData of triangles, 2-manifold, consistently oriented with normals out of the matter.
 * Input 1: the disparity maps from which it was made, or features; of a map only the view's own features
 * are used. Output: the same triangles and arrays with moved points, in the precision of the input. The
 * output has no self-intersection if the input has none. It does not depend on the number of threads.
 *
 * Settings out of range, cells that are not triangles and maps without cameras are errors, and the output
 * is empty; after an abort it is empty, too.
 *
 * @sa vtkBisectionContourFilter vtkFreespaceSurfaceFilter vtkSimplifySurfaceFilter
 *
 * @warning Beyond the paper. Details smaller than the distance between features are smoothed.
 */
#ifndef vtkFitSurfaceFilter_h
#define vtkFitSurfaceFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkFitSurfaceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkFitSurfaceFilter* New();
  vtkTypeMacro(vtkFitSurfaceFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of rounds, in each of which normals are filtered and vertices moved. 0 leaves the surface as it is.
   */
  vtkSetMacro(Rounds, int);
  vtkGetMacro(Rounds, int);
  ///@}

  ///@{
  /**
   * Number of iterations of the normal filter in each round.
   */
  vtkSetMacro(NormalIterations, int);
  vtkGetMacro(NormalIterations, int);
  ///@}

  ///@{
  /**
   * Standard deviation of the normal filter's range weight, as the length of the difference of two unit
   * normals: normals that differ by more than about twice as much do not affect each other.
   */
  vtkSetMacro(NormalDeviation, double);
  vtkGetMacro(NormalDeviation, double);
  ///@}

  ///@{
  /**
   * Expected deviation of a triangle from its filtered normal, radians: a smaller value gives a smoother
   * surface, a greater one a closer fit to the features.
   */
  vtkSetMacro(Waviness, double);
  vtkGetMacro(Waviness, double);
  ///@}

  ///@{
  /**
   * Features farther than this from the surface, as a fraction of their depth, are ignored.
   */
  vtkSetMacro(Reach, double);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * Maximum displacement of a vertex, in median edge lengths of the surface.
   */
  vtkSetMacro(MostMove, double);
  vtkGetMacro(MostMove, double);
  ///@}

protected:
  vtkFitSurfaceFilter();
  ~vtkFitSurfaceFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Rounds;
  int NormalIterations;
  double NormalDeviation;
  double Waviness;
  double Reach;
  double MostMove;

private:
  vtkFitSurfaceFilter(const vtkFitSurfaceFilter&) = delete;
  void operator=(const vtkFitSurfaceFilter&) = delete;
};

#endif
