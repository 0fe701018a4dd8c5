// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFitSurfaceFilter
 * @brief move a surface's vertices to where all features together say that it is
 *
 * The union of free spaces follows the deepest of its maps, and a map interpolates the noise of every
 * feature. This filter moves the vertices so that the surface is smooth but for sharp edges and fits the
 * features of all views in the sense of robust least squares, see FitSurface in the core.
 *
 * Input 0: a vtkPolyData of triangles, 2-manifold, consistently oriented with normals out of the matter.
 * Input 1: the disparity maps that it was made of, or features; of a map only the view's own features
 * count. Output: the same triangles and arrays with other points, in the input's precision; it meets
 * itself nowhere if the input did not. It is the same for any number of threads.
 *
 * Settings out of their range, cells that are no triangles and maps without cameras are an error, and
 * the output is empty; so it is after an abort.
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
   * How often normals are smoothed and vertices moved. 0 leaves the surface as it is.
   */
  vtkSetMacro(Rounds, int);
  vtkGetMacro(Rounds, int);
  ///@}

  ///@{
  /**
   * How often each triangle's normal is mixed with those beside it, in each round.
   */
  vtkSetMacro(NormalIterations, int);
  vtkGetMacro(NormalIterations, int);
  ///@}

  ///@{
  /**
   * Normals that differ by more than about two of it do not mix: the length of the difference of unit
   * normals.
   */
  vtkSetMacro(NormalDeviation, double);
  vtkGetMacro(NormalDeviation, double);
  ///@}

  ///@{
  /**
   * How far a triangle's slope may be off its smoothed normal, radians: less makes the surface
   * smoother, more lets it keep to its features.
   */
  vtkSetMacro(Waviness, double);
  vtkGetMacro(Waviness, double);
  ///@}

  ///@{
  /**
   * Features that are further off the surface belong to another one: a fraction of their depth.
   */
  vtkSetMacro(Reach, double);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * A vertex moves so far at most, in the median length of the surface's edges.
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
