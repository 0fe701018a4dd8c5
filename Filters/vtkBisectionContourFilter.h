// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBisectionContourFilter
 * @brief the boundary of the matter of an implicit function, by marching cubes with bisection
 *
 * Section 2.2 and figure 6 of the paper: wherever the function has different signs at two neighbouring
 * lattice points, the transition is located by bisection and becomes a vertex. Only the sign is used, so
 * discontinuous functions such as vtkFreespaceUnion are contoured exactly.
 *
 * Negative is matter (VTK's inside), and so is zero. Outside the bounds all is free. For a
 * vtkFreespaceUnion without a transform, whole boxes decide most of the lattice; any other function is
 * evaluated at every lattice point. That is done on all threads for vtkBox, vtkCone, vtkCylinder, vtkPlane,
 * vtkQuadric, vtkSphere and a vtkImplicitBoolean of these, without transforms; on one thread otherwise,
 * because VTK does not guarantee that functions are thread-safe.
 *
 * Output: a vtkPolyData of triangles, closed, 2-manifold, oriented with normals out of the matter, in the
 * unit of the function. Vertices keep the distance Clearance from lattice points, so that no triangle
 * degenerates. The result does not depend on the number of threads.
 *
 * | cell array | type          | meaning                                                         |
 * |------------|---------------|-----------------------------------------------------------------|
 * | View       | int           | index of the view that carved the triangle, -1 for the hull     |
 * | Kind       | unsigned char | 0 a feature triangle, 1 a silhouette wall, 2 hull or the bounds |
 * | Supported  | unsigned char | 1 if a feature is close to the triangle                         |
 *
 * The field array Lattice holds the number of cells along the longest side, the number of features, and
 * the number of features beyond the region of interest. All these arrays exist for a vtkFreespaceUnion
 * only.
 *
 * Silhouette walls are on the border of a view's map, and where a triangle with an angle of incidence
 * above 85 degrees spans a depth jump, from an occluding edge to the background.
 *
 * Honours UPDATE_PIECE_NUMBER and UPDATE_NUMBER_OF_PIECES: a piece is open where it meets others and has
 * the identical points there, which come last and are marked as duplicates in the point array
 * vtkGhostType. The other points of all pieces, one piece after the other, are those of the whole surface,
 * and so are the triangles.
 *
 * A missing function, bounds that are not a finite box, and a setting out of range are errors, and the
 * output is empty. So is a vtkFreespaceUnion with features but without a usable triangle: its views were
 * not triangulated, and the surface would be the hull. A function without any matter is not an error: the
 * output is empty. After an abort it is empty, too.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, section 2.2.
 *
 * @sa vtkFreespaceUnion vtkFreespaceSurfaceFilter vtkAppendPiecesFilter vtkFitSurfaceFilter
 *
 * @warning Matter thinner than a cell can be missed: the lattice samples it at its points only.
 */
#ifndef vtkBisectionContourFilter_h
#define vtkBisectionContourFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for the function

#include <memory> // for what is kept

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
   * The function that is contoured.
   */
  virtual void SetImplicitFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetImplicitFunction();
  ///@}

  ///@{
  /**
   * Bounds of the lattice. An uninitialized box (1, -1, ...), the default, takes the bounds of a
   * vtkFreespaceUnion; other functions require bounds.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Number of lattice cells along the longest side of the bounds. Automatic, or -1, is
   * vtkFreespaceUnion::GetSuggestedCells, or fewer to respect MemoryLimit, and 256 for other functions.
   * Default automatic.
   */
  vtkSetMacro(Cells, int);
  vtkGetMacro(Cells, int);
  void SetCellsToAutomatic() { this->SetCells(-1); }
  ///@}

  ///@{
  /**
   * Tolerance of the bisection, as a fraction of a cell. Default 0.001.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Minimum distance of a vertex from lattice points, as a fraction of a cell. Default 0.01.
   */
  vtkSetMacro(Clearance, double);
  vtkGetMacro(Clearance, double);
  ///@}

  ///@{
  /**
   * Use exact crossings where the function provides them, as a vtkFreespaceUnion with MinimumViews 1 does:
   * faster than bisection, and without its tolerance. Default on.
   */
  vtkSetMacro(ExactCrossings, vtkTypeBool);
  vtkGetMacro(ExactCrossings, vtkTypeBool);
  vtkBooleanMacro(ExactCrossings, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Reconstruct sharp edges and corners from the normals at the crossings (extended marching cubes, Kobbelt
   * et al., SIGGRAPH 2001), where normals within a cell differ by SharpAngle degrees or more. The surface
   * remains closed, 2-manifold and free of self-intersection. Off in the paper. Defaults on and 60 degrees:
   * the noise of features tilts small triangles by tens of degrees.
   */
  vtkSetMacro(SharpEdges, vtkTypeBool);
  vtkGetMacro(SharpEdges, vtkTypeBool);
  vtkBooleanMacro(SharpEdges, vtkTypeBool);
  vtkSetMacro(SharpAngle, double);
  vtkGetMacro(SharpAngle, double);
  ///@}

  ///@{
  /**
   * Keep crumbs: connected components of the surface without supporting features. They are otherwise
   * dropped, from pieces by vtkAppendPiecesFilter; the largest component is always kept. For a
   * vtkFreespaceUnion only. Default off.
   */
  vtkSetMacro(Crumbs, vtkTypeBool);
  vtkGetMacro(Crumbs, vtkTypeBool);
  vtkBooleanMacro(Crumbs, vtkTypeBool);
  ///@}

  /**
   * After Update(): the number of triangles that were dropped because Crumbs is off.
   */
  vtkGetMacro(CrumbTriangles, vtkIdType);

  ///@{
  /**
   * Keep only observed triangles: those of Kind 0, and those close to a feature. The result is an open
   * surface without the hull and the walls, which include the "extra" elements of the paper's figure 11.
   * For a vtkFreespaceUnion only. Default off.
   */
  vtkSetMacro(ObservedOnly, vtkTypeBool);
  vtkGetMacro(ObservedOnly, vtkTypeBool);
  vtkBooleanMacro(ObservedOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the points get Normals: of unit length, towards the free space, the mean of the normals of a point's
   * triangles; of a piece, of its own triangles. vtkFitSurfaceFilter keeps them up to date. Default off.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the blocks of the lattice are kept for the next update, which computes only those again that a change of the
   * function reaches: views that were added, removed or replaced leave what they do not see, see
   * vtkFreespaceUnion::AddView. The output is exactly that without it. All blocks are computed again when the lattice
   * changes (Bounds and Cells that are set keep it), with other settings or another number of deciding views; those at
   * the hull where its planes change (a HullMargin that is set keeps those that the features leave). Pieces are not kept.
   * Takes about half as much memory as the output. For a vtkFreespaceUnion without a Transform. Default off.
   */
  vtkSetMacro(Incremental, vtkTypeBool);
  vtkGetMacro(Incremental, vtkTypeBool);
  vtkBooleanMacro(Incremental, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Limit of the memory for the output (or the requested piece) and its computation, in MiB; 0 is no limit.
   * Exceeding it is an error that names both numbers, reported in advance for a vtkFreespaceUnion, and
   * otherwise as soon as it is known. Default 0.
   */
  vtkSetMacro(MemoryLimit, double);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  /**
   * Estimate of the memory for the whole output and its computation, in MiB, in a fraction of the time. 0 if
   * the function is not a vtkFreespaceUnion, and after an abort.
   */
  double EstimateMemory();

  /**
   * The number of cells of the lattice with the current settings, automatic or not. 0 if it is unknown.
   */
  int FindCells();

  /**
   * Includes the function.
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
  vtkIdType CrumbTriangles = 0;
  vtkTypeBool ObservedOnly;
  vtkTypeBool ComputeNormals = false;
  vtkTypeBool Incremental = false;
  double MemoryLimit;

private:
  struct Task;
  struct Memory;
  template <typename Allocate>
  void Contour(const Task& task, const Allocate& allocate, const freespace::Progress& progress);
  bool Prepare(Task& task, const freespace::Progress& progress);
  void ChooseCells(Task& task, const freespace::Progress& progress);
  double ShareOfBuilding();

  std::unique_ptr<Memory> Last;

  vtkBisectionContourFilter(const vtkBisectionContourFilter&) = delete;
  void operator=(const vtkBisectionContourFilter&) = delete;
};

#endif
