// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFreespaceUnion
 * @brief the union of the free spaces of triangulated views, as an implicit function
 *
 * Phi' of section 2.2 of the paper. A point is free if, in some view, it is in front of the triangulated
 * disparity map, or if it is outside the convex hull of the features in the region of interest.
 *
 * **Sign**: negative in matter, positive in free space, zero on the boundary; the gradient points out of
 * the matter. **Value**: a length, in the unit of the camera model: the greater of the signed distance to
 * the hull and, over the views that claim the point, the depth of the map less the depth of the point. It
 * is continuous except where the claim of a view ends, at the silhouette walls through the border of its
 * map. A view does not claim points that are outside all triangles of its map, or behind the camera.
 *
 * Without a margin the hull cuts away all matter that lies on it and has no thickness, such as a board
 * under the scene; HullMargin moves the hull outward.
 *
 * Input: a vtkMultiBlockDataSet or vtkPartitionedDataSetCollection of disparity maps (see the README for the
 * arrays), by SetMaps, or from a pipeline by SetInputConnection. Features that are not finite are ignored, and so are triangles with such
 * a corner or with a corner that is not in front of the camera. Without any feature, all space is free. A
 * block that is not a map is an error, see IsValid. The function is then negative everywhere, and queries
 * fail closed: nothing is free. Neither are coordinates that are not finite.
 *
 * The acceleration structures are built at the first evaluation after a change. Evaluation is thread-safe.
 * Maps that were modified in place are noticed by GetMTime, which every VTK filter calls before it
 * executes; code that evaluates directly calls Update first.
 *
 * Building takes seconds for many views, and so can a batch of queries. Both report progress like an
 * algorithm: ProgressEvent carries the fraction done, from the calling thread, and an observer that sets
 * AbortExecute stops them within a tenth of a second. A function whose building was stopped is not valid
 * and is rebuilt at the next call; a stopped batch has no results. A class that builds the function on its
 * own behalf, such as vtkBisectionContourFilter, reports this as a part of its own progress and honours
 * its own AbortExecute. An evaluation of a function that is not up to date builds it without events.
 *
 * It works wherever VTK takes a vtkImplicitFunction: vtkSampleFunction, vtkCutter, vtkClipPolyData.
 * vtkBisectionContourFilter extracts its boundary without evaluating most of the volume.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, section 2.2.
 *
 * @sa vtkDelaunayDisparityFilter vtkBisectionContourFilter vtkFreespaceSurfaceFilter vtkOccupancyMapWriter
 *
 * @warning Free space is claimed by interpolation between features. One wrong feature far behind the
 * surface can carve a hole through matter where no other view contradicts it, or MinimumViews is 1.
 */
#ifndef vtkFreespaceUnion_h
#define vtkFreespaceUnion_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkImplicitFunction.h"

#include <memory> // for the inner structures
#include <string> // for the names of views

class vtkAlgorithmOutput;
class vtkDataObject;
class vtkDoubleArray;
class vtkMultiBlockDataSet;
class vtkPoints;
class vtkPolyData;
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
   * The disparity maps, one block per view. Replaces a connection. SetInputDataObject takes a
   * vtkPartitionedDataSetCollection, too.
   */
  virtual void SetMaps(vtkMultiBlockDataSet* maps);
  vtkMultiBlockDataSet* GetMaps();
  void SetInputData(vtkMultiBlockDataSet* maps) { this->SetMaps(maps); }
  void SetInputDataObject(vtkDataObject* maps);
  ///@}

  ///@{
  /**
   * Adds a view to the maps, at the end, or in place of one of its name; or removes one, by its name or index. The next
   * update makes only what depends on all of them: the structures of the other views are kept, as they are by
   * SetMaps for blocks that are the same unmodified objects at the same place. The result is that of all maps from
   * the beginning.
   *
   * GetMaps returns the new maps. They are a data set of the function's own, which shares the blocks: the one that was
   * given does not change. SourceView of the new map holds the indices that views have then; where it was made with
   * others, such as by itself, sourceIndex is the one that it has for the view's own points. SourceView of the other maps
   * follows when one is removed, and is 2147483647 for points that came from it.
   *
   * Return false, with an error, where there is no such map, or where the maps come from a pipeline.
   */
  bool AddView(const std::string& name, vtkPolyData* map, int sourceIndex = -1);
  bool RemoveView(const std::string& name);
  bool RemoveView(int index);
  ///@}

  ///@{
  /**
   * Takes the maps from a pipeline, which is updated together with the function.
   */
  virtual void SetInputConnection(vtkAlgorithmOutput* output);
  vtkAlgorithmOutput* GetInputConnection();
  ///@}

  ///@{
  /**
   * Number of views in whose free space a point must be to be free; 1 in the paper. A number above that of
   * the views is an error. Automatic, or -1, is three, or fewer where no more views contradict them: those
   * that have the point closely behind their own surface, by the distance of their features there. FindMinimumViews
   * returns the number that decides in any case, after an Update. Default automatic.
   */
  vtkSetMacro(MinimumViews, int);
  vtkGetMacro(MinimumViews, int);
  void SetMinimumViewsToAutomatic() { this->SetMinimumViews(-1); }
  int FindMinimumViews();
  ///@}

  ///@{
  /**
   * Offset of the hull's planes to the outside, as a fraction of the diagonal of the bounding box of the
   * features in the region; 0 in the paper. A value of 10 or more is an error. Automatic, or -1, is
   * slightly more than a cell of the lattice of GetSuggestedCells, or than the distance of the features where
   * they are sparse, since the surface extends beyond the outermost ones; at most 0.02. Default automatic.
   */
  vtkSetMacro(HullMargin, double);
  vtkGetMacro(HullMargin, double);
  void SetHullMarginToAutomatic() { this->SetHullMargin(-1); }
  ///@}

  ///@{
  /**
   * How far behind its own surface a view contradicts that a place is free, with automatic MinimumViews: the length
   * that the distance of its features, in the image, has there, times this. Farther behind it the place may be hidden,
   * and the view has no vote. Above 0. Default 1.
   */
  vtkSetMacro(Contradiction, double);
  vtkGetMacro(Contradiction, double);
  ///@}

  enum RegionModes
  {
    AUTOMATIC_REGION = 0,
    WHOLE_REGION = 1,
    BOX_REGION = 2
  };

  ///@{
  /**
   * The region of interest, whose features define the hull and the bounds; features beyond it claim free
   * space like all others. It is found from the features (automatic), contains all of them (whole), or is a
   * box (x0, x1, y0, y1, z0, z1) in world coordinates; SetRegion also sets the mode. Without it a few
   * features far behind the scene determine the size of the lattice. Default automatic, which equals whole
   * where the features are one compact cluster.
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
   * Results of an Update: the bounding box of the features in the region (1, -1, ... without any), the
   * number of features, the number of them beyond the region, and the number of lattice cells along the
   * longest side that resolves the features, from the footprint of pixels and the distances of features.
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

  /**
   * What is known of a point: MATTER; FREE, which was seen; or UNKNOWN, outside of the hull and never seen,
   * which is free for Phi'. A point that is not finite is UNKNOWN, and so are all where the maps are not valid.
   */
  enum PointStates
  {
    MATTER = 0,
    FREE = 1,
    UNKNOWN = 2
  };

  ///@{
  /**
   * Queries for "obstacle avoidance and ray tracing", the last page of the paper. They update the function
   * first; several threads may call them only after an Update. Coordinates are those of the function, a
   * Transform is not applied. Matter is closed.
   *
   * FirstBlocked returns the parameter at which a segment first leaves free space, as a fraction of the
   * segment, exactly: 0 if it begins in matter, infinity if all of it is free. IsSphereFree and IsBoxFree
   * return whether a closed ball or box (x0, x1, y0, y1, z0, z1) is free. True is certain; false can also
   * mean that matter is closer than about a thousandth of the body's size, or that the free spaces of two
   * views only touch in it.
   */
  bool IsPointFree(const double point[3]);
  int GetPointState(const double point[3]);
  double FirstBlocked(const double first[3], const double last[3]);
  bool IsSegmentFree(const double first[3], const double last[3])
  {
    return this->FirstBlocked(first, last) > 1.0;
  }
  bool IsSphereFree(const double center[3], double radius);
  bool IsBoxFree(const double bounds[6]);
  ///@}

  ///@{
  /**
   * The same in batches, on all threads. Results are resized to one value for each point, segment or ball, 1
   * where it is free. Returns false with an error if the numbers of points differ, and without an error
   * and without results if an observer aborted.
   */
  bool ArePointsFree(vtkPoints* points, vtkUnsignedCharArray* free);
  bool GetPointStates(vtkPoints* points, vtkUnsignedCharArray* states);
  bool FirstBlocked(vtkPoints* first, vtkPoints* last, vtkDoubleArray* fractions);
  bool AreSpheresFree(vtkPoints* centers, vtkDoubleArray* radii, vtkUnsignedCharArray* free);
  ///@}

  /**
   * Updates the maps and the acceleration structures.
   */
  void Update();

  ///@{
  /**
   * Set by an observer of ProgressEvent to abort. Reset when building or a batch begins.
   */
  void SetAbortExecute(vtkTypeBool abort) { this->AbortExecute = abort; }
  vtkGetMacro(AbortExecute, vtkTypeBool);
  ///@}

  /**
   * Whether the maps are valid, after an Update.
   */
  bool IsValid();

  /**
   * The bounding box of the hull with its margin, after an Update; all is free outside it. Without features
   * an uninitialized box (1, -1, ...).
   */
  void GetBounds(double bounds[6]);

  /**
   * Includes the maps, their blocks and the pipeline that generates them.
   */
  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  ///@{
  /**
   * The core's function, up to date; null if the maps are not valid. A class that builds it on its own
   * behalf passes its own progress, which throws freespace::Aborted to stop. IsBuilt returns whether
   * it is up to date.
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
  double Contradiction;
  int RegionMode = AUTOMATIC_REGION;
  double Region[6] = { 1, -1, 1, -1, 1, -1 };
  vtkTypeBool AbortExecute = 0;

private:
  vtkFreespaceUnion(const vtkFreespaceUnion&) = delete;
  void operator=(const vtkFreespaceUnion&) = delete;

  struct Internals;
  template <typename Change>
  bool Edit(const Change& change);
  const freespace::FreespaceUnion* Built();
  void Build(const freespace::Progress& progress);
  freespace::Progress OwnProgress();
  bool AreThere(vtkObject* first, vtkObject* second);
  bool HaveSameSize(vtkIdType size, vtkIdType otherSize);

  std::unique_ptr<Internals> Inner;
};

#endif
