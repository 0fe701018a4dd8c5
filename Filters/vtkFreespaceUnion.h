// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFreespaceUnion
 * @brief the union of the free spaces of triangulated views, as an implicit function
 *
 * Phi' of section 2.2 of the paper. A point is free when it lies, seen from some view, in front of
 * the view's triangulated disparity map, or when it lies outside of the convex hull of the
 * features in the region of interest.
 *
 * **Sign**: negative in matter, positive in free space, zero on the boundary; the gradient points
 * out of the matter. **Value**: a length, in the unit of the camera model: the greater of the
 * signed distance to the hull and, over the views that claim the point, the depth of the map less
 * the depth of the point. It is continuous but for steps where the claim of a view ends, at the
 * silhouette walls through the border of its map. A point that falls outside of all triangles of a
 * view, or behind it, is not claimed by the view.
 *
 * Taken literally, the hull cuts away all matter that lies on it and has no thickness there, such
 * as a board under the scene: HullMargin pushes the hull out.
 *
 * Input: a vtkMultiBlockDataSet of disparity maps (see the README for the arrays), by SetMaps, or
 * from a pipeline by SetInputConnection. Features that are not finite are left out, and so are
 * triangles that touch one or a point that is not in front of its camera. Where there is no feature
 * at all, everything is free. A block that is not a map is an error: IsValid tells. The function is then
 * positive everywhere, but queries fail closed: nothing is free. Neither is what is not finite.
 *
 * The inner structures are built at the first evaluation after a change. Evaluation is safe from
 * several threads. Maps that were changed in place are noticed by GetMTime, which every VTK filter
 * asks before it executes; who evaluates by hand calls Update first.
 *
 * Building takes seconds where there are many views, and so may a batch of queries. Both are watched
 * like an algorithm: ProgressEvent tells the fraction done, from the calling thread, and an observer
 * that sets AbortExecute stops them within a tenth of a second. A function that was stopped while it was
 * built is not valid, and is built anew when it is next asked; a stopped batch is empty. What builds the
 * function on its own behalf, such as vtkBisectionContourFilter, shows the building as a part of its own
 * progress and hears its own AbortExecute. Evaluations of a function that is not up to date build it
 * without an event.
 *
 * Usable wherever VTK takes a vtkImplicitFunction: vtkSampleFunction, vtkCutter, vtkClipPolyData.
 * vtkBisectionContourFilter finds its boundary without asking most of the volume.
 */
#ifndef vtkFreespaceUnion_h
#define vtkFreespaceUnion_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkImplicitFunction.h"

#include <memory> // for the inner structures

class vtkAlgorithmOutput;
class vtkDoubleArray;
class vtkMultiBlockDataSet;
class vtkPoints;
class vtkUnsignedCharArray;
namespace freespace
{
class FreespaceUnion;
class Progress;
}

class VTKFREESPACEFILTERS_EXPORT vtkFreespaceUnion : public vtkImplicitFunction
{
public:
  static vtkFreespaceUnion* New();
  vtkTypeMacro(vtkFreespaceUnion, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The disparity maps, one block per view. Takes the place of a connection.
   */
  virtual void SetMaps(vtkMultiBlockDataSet* maps);
  vtkMultiBlockDataSet* GetMaps();
  void SetInputData(vtkMultiBlockDataSet* maps) { this->SetMaps(maps); }
  ///@}

  ///@{
  /**
   * Takes the maps from a pipeline, which is brought up to date when the function is.
   */
  virtual void SetInputConnection(vtkAlgorithmOutput* output);
  vtkAlgorithmOutput* GetInputConnection();
  ///@}

  ///@{
  /**
   * So many views must agree that a point is free. 1 is the paper. More than there are views is an error.
   * Automatic, or -1, is 1 or 2, by how often the views contradict each other at features; FindMinimumViews
   * tells which, after an Update. Default automatic.
   */
  vtkSetMacro(MinimumViews, int);
  vtkGetMacro(MinimumViews, int);
  void SetMinimumViewsToAutomatic() { this->SetMinimumViews(-1); }
  int FindMinimumViews();
  ///@}

  ///@{
  /**
   * By how much the hull is pushed out, as a fraction of the diagonal of the bounding box of the features
   * in the region. 0 is the paper, 10 and more an error. Automatic, or -1, is somewhat more than a cell
   * of the lattice that GetSuggestedCells tells. Default automatic.
   */
  vtkSetMacro(HullMargin, double);
  vtkGetMacro(HullMargin, double);
  void SetHullMarginToAutomatic() { this->SetHullMargin(-1); }
  ///@}

  enum RegionModes
  {
    AUTOMATIC_REGION = 0,
    WHOLE_REGION = 1,
    BOX_REGION = 2
  };

  ///@{
  /**
   * The region of interest: the hull, and with it the bounds, are those of the features in it; features
   * beyond carve like all others. It is found from the features, holds all of them, or is a box (x0, x1,
   * y0, y1, z0, z1) in world coordinates, whose setting sets the mode. A few features far behind the
   * scene would else decide how large the lattice is. Default automatic, which is the whole where the
   * features are one compact body.
   */
  vtkSetClampMacro(RegionMode, int, AUTOMATIC_REGION, BOX_REGION);
  vtkGetMacro(RegionMode, int);
  void SetRegionModeToAutomatic() { this->SetRegionMode(AUTOMATIC_REGION); }
  void SetRegionModeToWhole() { this->SetRegionMode(WHOLE_REGION); }
  void SetRegion(double x0, double x1, double y0, double y1, double z0, double z1);
  void SetRegion(const double bounds[6]);
  vtkGetVector6Macro(Region, double);
  ///@}

  ///@{
  /**
   * What was found, after an Update: the box of the features in the region (1, -1, ... without any), how many
   * features there are, how many of them lie beyond the region, and how many cells along its longest
   * side show what the features tell, by the footprint of their pixels and their distances.
   */
  void GetRegionBounds(double bounds[6]);
  vtkIdType GetNumberOfFeatures();
  vtkIdType GetNumberOfFeaturesBeyond();
  int GetSuggestedCells();
  ///@}

  ///@{
  /**
   * The function and its gradient at a point.
   */
  using Superclass::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;
  void EvaluateGradient(double x[3], double g[3]) override;
  ///@}

  ///@{
  /**
   * Queries of the last page of the paper, "obstacle avoidance and ray tracing". They bring the
   * function up to date first, so that several threads may ask only after an Update. Coordinates are
   * the function's own: a Transform is not applied. Matter is closed.
   *
   * FirstBlocked is the first place where a segment leaves free space, as a fraction of it, exact:
   * 0 when it begins in matter, infinite when all of it is free. IsSphereFree and IsBoxFree tell
   * whether all of a closed ball or box (x0, x1, y0, y1, z0, z1) is free: true is certain; false can
   * also mean that matter is closer than about a thousandth of the body's size, or that the free
   * spaces of two views only just meet in it.
   */
  bool IsPointFree(const double point[3]);
  double FirstBlocked(const double first[3], const double last[3]);
  bool IsSegmentFree(const double first[3], const double last[3]);
  bool IsSphereFree(const double center[3], double radius);
  bool IsBoxFree(const double bounds[6]);
  ///@}

  ///@{
  /**
   * The same in batches, on all threads: results are resized to one value for each point (segment,
   * ball), 1 where it is free. False, with an error, when the numbers of points do not agree, and
   * without one, and without results, when an observer stopped it.
   */
  bool ArePointsFree(vtkPoints* points, vtkUnsignedCharArray* free);
  bool FirstBlocked(vtkPoints* first, vtkPoints* last, vtkDoubleArray* fractions);
  bool AreSpheresFree(vtkPoints* centers, vtkDoubleArray* radii, vtkUnsignedCharArray* free);
  ///@}

  /**
   * Brings the maps and the inner structures up to date.
   */
  void Update();

  ///@{
  /**
   * Set by an observer of ProgressEvent to stop what is going on. Taken back when something begins.
   */
  void SetAbortExecute(vtkTypeBool abort) { this->AbortExecute = abort; }
  vtkGetMacro(AbortExecute, vtkTypeBool);
  ///@}

  /**
   * Whether the maps could be used, after an Update.
   */
  bool IsValid();

  /**
   * The box of the pushed out hull, after an Update: outside of it all is free. Without features an
   * uninitialized box (1, -1, ...).
   */
  void GetBounds(double bounds[6]);

  /**
   * Covers the maps, their blocks and the pipeline they come from.
   */
  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  ///@{
  /**
   * The core's function, up to date; null where the maps are not valid. For classes that build it on
   * their own behalf: with a progress of theirs in place of the function's, which makes it throw
   * freespace::Aborted when it wants to stop. IsBuilt tells whether there is nothing to do for it.
   */
  std::shared_ptr<const freespace::FreespaceUnion> GetCore();
  std::shared_ptr<const freespace::FreespaceUnion> GetCore(const freespace::Progress& progress);
  bool IsBuilt();
  ///@}
#endif

protected:
  vtkFreespaceUnion();
  ~vtkFreespaceUnion() override;

  // Defaults are those of freespace::FreespaceUnionOptions.
  int MinimumViews;
  double HullMargin;
  int RegionMode = AUTOMATIC_REGION;
  double Region[6] = { 1, -1, 1, -1, 1, -1 };
  vtkTypeBool AbortExecute = 0;

private:
  vtkFreespaceUnion(const vtkFreespaceUnion&) = delete;
  void operator=(const vtkFreespaceUnion&) = delete;

  struct Internals;
  const freespace::FreespaceUnion* Built();
  void Build(const freespace::Progress& progress);
  freespace::Progress OwnProgress();
  bool HaveSameSize(vtkIdType size, vtkIdType otherSize);

  std::unique_ptr<Internals> Inner;
};

#endif
