// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDelaunayDisparityFilter
 * @brief a triangulated disparity map for each view, under the minimum disparity constraint
 *
 * Triangulates the features of each view in its image (Delaunay) and interpolates their disparity
 * (1 / depth) linearly. Disparity is affine over the image of a plane, so that each triangle of the
 * map is the image of the triangle between the world points. What lies between the camera and the
 * triangles is the view's free space (section 2 of the paper).
 *
 * The free space of no view may contain a feature that another view recovered (section 2.1, the
 * minimum disparity constraint). With MinimumDisparity on, the points of the other views that stick
 * out of a view's surface are inserted into its triangulation, always the one that is highest above
 * the current surface in disparity, until none is above it by more than Tolerance. Points count
 * where they are in front of the camera and project into the convex hull of the view's own
 * features.
 *
 * Outliers would spoil every other view, so before anything else features are dropped that fewer
 * than SupportingNeighbors of the six nearest in their view agree with (end of section 2.2: support
 * in the image neighbourhood), and, beyond the paper, those that SeeThroughViews other views see
 * through. A view that would keep fewer than three features keeps all.
 *
 * Beyond the paper, with ContinueBackground on: where a near edge occludes a far surface the
 * triangulation joins the two by bridges that no surface carries. A bridge, seen at GrazingAngle or
 * more to its normal, through which RefutingViews other views see close to its near side, has its
 * near corners set back to the surface behind: the one that another view has there, or else the plane
 * of the far features around. Off is the paper.
 *
 * Triangles longer than LongestEdge in the image, or than GreatestDepthRatio in depth, can be left
 * out, so that they carve nothing: for sparse features, among which long triangles are no surface.
 *
 * Input: a vtkMultiBlockDataSet of views, as vtkEdgeStereoReader and vtkFeatureSupportFilter make
 * it. Output: the same blocks with triangles. Point data: `ImagePoint` (double x2, pixels) is where
 * the world point projects, which for a view's own features can differ from where it was seen;
 * `SourceView` (int) is the index of the view that supplied the point. Field data as in the input.
 * Features that are not finite, not in front of the camera, or outside the image are left out.
 *
 * A view with fewer than three usable features, or with none but collinear ones, is an error: the
 * filter names the view and its output is empty. Views are worked on in parallel by vtkSMPTools;
 * the result does not depend on the number of threads.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, sections 2 and 2.1.
 */
#ifndef vtkDelaunayDisparityFilter_h
#define vtkDelaunayDisparityFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkDelaunayDisparityFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkDelaunayDisparityFilter* New();
  vtkTypeMacro(vtkDelaunayDisparityFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether the minimum disparity constraint is enforced. Default on.
   */
  vtkSetMacro(MinimumDisparity, vtkTypeBool);
  vtkGetMacro(MinimumDisparity, vtkTypeBool);
  vtkBooleanMacro(MinimumDisparity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How far a point of another view may stick out of a view's surface, as a fraction of its
   * disparity (to first order: of its depth). 0 is the paper; it draws the surface towards the
   * camera by the noise of the features. Default 0.0002.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Whether the triangulation keeps the lines of a view's block (edge chains), so that no triangle
   * crosses an edge that the stereo saw. Lines that cross others are not kept. Off is the paper.
   * Default off.
   */
  vtkSetMacro(KeepEdges, vtkTypeBool);
  vtkGetMacro(KeepEdges, vtkTypeBool);
  vtkBooleanMacro(KeepEdges, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the background is continued below bridges that other views see through. Off is the paper.
   * Default on.
   */
  vtkSetMacro(ContinueBackground, vtkTypeBool);
  vtkGetMacro(ContinueBackground, vtkTypeBool);
  vtkBooleanMacro(ContinueBackground, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The angle to its normal, degrees, from which a triangle that spans a jump is taken for a bridge.
   * Default 70.
   */
  vtkSetMacro(GrazingAngle, double);
  vtkGetMacro(GrazingAngle, double);
  ///@}

  ///@{
  /**
   * How many other views must see through a bridge. Default 1.
   */
  vtkSetMacro(RefutingViews, int);
  vtkGetMacro(RefutingViews, int);
  ///@}

  ///@{
  /**
   * How many of the six features that are nearest in the image (within two triangles) must agree with
   * a feature's disparity. 0 keeps all. Default 2.
   */
  vtkSetMacro(SupportingNeighbors, int);
  vtkGetMacro(SupportingNeighbors, int);
  ///@}

  ///@{
  /**
   * How many other views must see through a feature, and more than see it, for it to be dropped. 0, the
   * default and the paper, drops none.
   */
  vtkSetMacro(SeeThroughViews, int);
  vtkGetMacro(SeeThroughViews, int);
  ///@}

  ///@{
  /**
   * A triangle that so many supported features of other views violate (they lie in its free space), and
   * more than lie on it, is wrong. A feature that is the deepest corner of wrong triangles most of the
   * way round is dropped before the constraint is enforced. 0, the default and the paper, drops none.
   */
  vtkSetMacro(ViolatingFeatures, int);
  vtkGetMacro(ViolatingFeatures, int);
  ///@}

  ///@{
  /**
   * Triangles with a longer edge in the image, pixels, carve nothing. 0, the default and the paper, is
   * no limit.
   */
  vtkSetMacro(LongestEdge, double);
  vtkGetMacro(LongestEdge, double);
  ///@}

  ///@{
  /**
   * Triangles whose farthest corner is deeper than this many times the nearest carve nothing. Above 1;
   * 0, the default and the paper, is no limit.
   */
  vtkSetMacro(GreatestDepthRatio, double);
  vtkGetMacro(GreatestDepthRatio, double);
  ///@}

protected:
  vtkDelaunayDisparityFilter();
  ~vtkDelaunayDisparityFilter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  // Defaults are those of the options structs in Filters/Core/Disparity.
  vtkTypeBool MinimumDisparity;
  double Tolerance;
  vtkTypeBool KeepEdges;
  vtkTypeBool ContinueBackground;
  double GrazingAngle;
  int RefutingViews;
  int SupportingNeighbors;
  int SeeThroughViews;
  int ViolatingFeatures;
  double LongestEdge;
  double GreatestDepthRatio;

private:
  vtkDelaunayDisparityFilter(const vtkDelaunayDisparityFilter&) = delete;
  void operator=(const vtkDelaunayDisparityFilter&) = delete;
};

#endif
