// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBisectionContourFilter
 * @brief the boundary of an implicit function's matter, by marching cubes with bisection
 *
 * Section 2.2 and figure 6 of the paper: wherever two neighbouring points of a lattice differ in
 * the sign of the function, the transition is located by bisection and becomes a vertex. Only the
 * sign counts, so functions with steps, such as vtkFreespaceUnion, are contoured exactly.
 *
 * Negative is matter (VTK's inside); zero counts as matter. What lies outside of the bounds counts
 * as free. For a vtkFreespaceUnion without a transform, most of the lattice is decided by whole
 * boxes; any other function is asked at every lattice point, on one thread, since VTK's functions
 * do not promise more.
 *
 * Output: a vtkPolyData of triangles, closed, oriented with normals out of the matter, 2-manifold,
 * in the unit of the function, points in double precision. Vertices keep the distance Clearance
 * from lattice points, so that no triangle vanishes. It is the same for any number of threads.
 *
 * | cell array | type          | meaning                                                         |
 * |------------|---------------|-----------------------------------------------------------------|
 * | View       | int           | index of the view that carved the triangle, -1 for the hull     |
 * | Kind       | unsigned char | 0 a feature triangle, 1 a silhouette wall, 2 hull or the bounds |
 * | Supported  | unsigned char | 1 where a feature is beside the triangle                         |
 *
 * The field array Lattice has the number of cells, of features, and of those beyond the region of interest.
 *
 * Silhouette walls stand on the border of a view's map, and where a triangle that the view sees
 * edge-on (above 85 degrees) spans a jump in depth, from an occluding edge to what lies behind.
 *
 * Honours UPDATE_PIECE_NUMBER and UPDATE_NUMBER_OF_PIECES: a piece is open where it meets others, and
 * has exactly their points there, which come last and are marked as duplicates in the point array
 * vtkGhostType. The other points of all pieces, one piece after the other, are those of the whole
 * surface, and so are the triangles.
 *
 * The arrays are there for a vtkFreespaceUnion only. Without a function, with bounds that are not a
 * finite box, or with a setting out of its range, the filter tells an error and its output is
 * empty. So does a vtkFreespaceUnion with features of which no view has a usable triangle: they
 * were not triangulated, and the surface would be the hull. A function without any matter is no error: the output is empty. So it is after an abort.
 */
#ifndef vtkBisectionContourFilter_h
#define vtkBisectionContourFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for the function

class vtkImplicitFunction;
namespace freespace
{
class Progress;
}

class VTKFREESPACEFILTERS_EXPORT vtkBisectionContourFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkBisectionContourFilter* New();
  vtkTypeMacro(vtkBisectionContourFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The function whose zero set is the surface.
   */
  virtual void SetImplicitFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetImplicitFunction();
  ///@}

  ///@{
  /**
   * Where to look. An uninitialized box (1, -1, ...), the default, takes the bounds of a
   * vtkFreespaceUnion's hull; for other functions bounds must be given.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * How many cells the lattice has along the longest side of the bounds. Automatic, or -1, takes the cells
   * that a vtkFreespaceUnion suggests, or fewer where MemoryLimit asks for it, and 256 for other
   * functions. Default automatic.
   */
  vtkSetMacro(Cells, int);
  vtkGetMacro(Cells, int);
  void SetCellsToAutomatic() { this->SetCells(-1); }
  ///@}

  ///@{
  /**
   * The tolerance of the bisection, as a fraction of a cell. Default 0.001.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The least distance of a vertex from the lattice's points, as a fraction of a cell. Default
   * 0.01.
   */
  vtkSetMacro(Clearance, double);
  vtkGetMacro(Clearance, double);
  ///@}

  ///@{
  /**
   * Take crossings exactly where the function knows them, as a vtkFreespaceUnion with MinimumViews 1
   * does: faster than bisection, and without its tolerance. Default on.
   */
  vtkSetMacro(ExactCrossings, vtkTypeBool);
  vtkGetMacro(ExactCrossings, vtkTypeBool);
  vtkBooleanMacro(ExactCrossings, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Rebuild sharp edges and corners from the normals at the crossings (extended marching cubes, Kobbelt
   * et al., SIGGRAPH 2001), where normals within a cell differ by SharpAngle degrees or more. The
   * surface stays closed, 2-manifold and free of self-intersection. Defaults on and 60 degrees: the noise of
   * features tilts small triangles by tens of degrees. Off is the paper.
   */
  vtkSetMacro(SharpEdges, vtkTypeBool);
  vtkGetMacro(SharpEdges, vtkTypeBool);
  vtkBooleanMacro(SharpEdges, vtkTypeBool);
  vtkSetMacro(SharpAngle, double);
  vtkGetMacro(SharpAngle, double);
  ///@}

  ///@{
  /**
   * Keep crumbs: connected components of the surface that no feature supports. Else they are left out of a
   * surface that is made whole, and by vtkAppendPiecesFilter of one that is joined from pieces; the
   * largest component always stays. For a vtkFreespaceUnion only. Default off.
   */
  vtkSetMacro(Crumbs, vtkTypeBool);
  vtkGetMacro(Crumbs, vtkTypeBool);
  vtkBooleanMacro(Crumbs, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Keep only what was seen: the triangles of Kind 0, and those that have a feature beside them. That leaves
   * an open surface without the hull and the walls, among them the "extra" elements of the paper's figure
   * 11. For a vtkFreespaceUnion only. Default off.
   */
  vtkSetMacro(ObservedOnly, vtkTypeBool);
  vtkGetMacro(ObservedOnly, vtkTypeBool);
  vtkBooleanMacro(ObservedOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How much memory the output (or the piece of it that is asked for) and its making may take, in MiB;
   * 0 is no limit. What would take more is an error that names both, told before the work where the
   * function is a vtkFreespaceUnion, and otherwise as soon as it is known. Default 0.
   */
  vtkSetMacro(MemoryLimit, double);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  /**
   * About how much memory the whole output and its making will take, in MiB: found in a fraction of the
   * time. 0 when the function cannot tell, which only a vtkFreespaceUnion can, and when it was stopped.
   */
  double EstimateMemory();

  /**
   * How many cells the lattice has, automatic or not, for what is set. 0 when it cannot be told.
   */
  int FindCells();

  /**
   * Covers the function.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkBisectionContourFilter();
  ~vtkBisectionContourFilter() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkSmartPointer<vtkImplicitFunction> ImplicitFunction;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 };
  int Cells;
  // Defaults are those of freespace::ContourOptions and freespace::TriangleSelection.
  double Tolerance;
  double Clearance;
  vtkTypeBool ExactCrossings;
  vtkTypeBool SharpEdges;
  double SharpAngle;
  vtkTypeBool Crumbs;
  vtkTypeBool ObservedOnly;
  double MemoryLimit;

private:
  struct Task;
  bool Prepare(Task& task, const freespace::Progress& progress);
  void ChooseCells(Task& task, const freespace::Progress& progress);
  double ShareOfBuilding();

  vtkBisectionContourFilter(const vtkBisectionContourFilter&) = delete;
  void operator=(const vtkBisectionContourFilter&) = delete;
};

#endif
