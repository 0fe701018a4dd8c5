// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDelaunayDisparityFilter
 * @brief a triangulated disparity map for each view, under the minimum disparity constraint
 *
 * The filter works in five steps.
 *
 * **Thinning.** Beyond the paper, features of one view that are closer than FeatureSpacing in the image, at one
 * depth, become one: their mean, weighted by the inverse variances of the optional array `DisparityDeviation`
 * (standard deviation of 1 / depth). Closer ones tell more of their noise than of the surface.
 *
 * **Outliers.** One outlier in front of the scene would reach every other view through the minimum
 * disparity constraint. A feature is dropped when fewer than Support features in its neighbourhood in the
 * image have a similar disparity (end of section 2.2), and, beyond the paper, when it is in the free space of
 * SeeThroughViews other views, or behind triangles that ViolatingFeatures features of other views violate. This
 * step and its settings are those of the superclass, vtkOutlierFilter.
 *
 * **Disparity.** The features of each view are triangulated in its image (Delaunay); their disparity
 * (1 / depth) is interpolated linearly. Disparity is affine over the image of a plane, so each triangle of
 * the map is the image of the triangle between the world points. The space between the camera and the
 * triangles is the view's free space (section 2). The free space of no view may contain a feature that
 * another view recovered (section 2.1, the minimum disparity constraint): with MinimumDisparity on, points
 * of other views are inserted into the triangulation, always the one that is highest above the current
 * surface in disparity, until none is above it by more than Tolerance. Only points that are in front of
 * the camera and project into the convex hull of the view's own features are considered.
 *
 * **Background.** Beyond the paper, with ContinueBackground on: at an occlusion boundary the triangulation
 * joins the near edge and the far surface by bridges, triangles that are on no surface. A bridge whose
 * angle of incidence is at least GrazingAngle, and which lies in the free space of RefutingViews other
 * views close to its near side, has its near corners moved back to the surface behind the edge.
 *
 * **Trim.** Triangles with an edge longer than LongestEdge in the image, or with a ratio of depths above
 * GreatestDepthRatio, claim no free space. This is meant for sparse features, between which long triangles
 * are not on a surface.
 *
 * Input: a vtkMultiBlockDataSet of views, as vtkEdgeStereoReader, vtkSparseModelReader and
 * vtkOutlierFilter generate it. Output: the same blocks with triangles. Point data: `ImagePoint`
 * (double x2, pixels) is the projection of the world point, which for a view's own features can differ
 * from where it was observed; `SourceView` (int) is the index of the view that supplied the point;
 * `DisparityDeviation` (double, where the input has it) is that of a view's own features, 0 elsewhere. Field
 * data pass. Features that are not finite, not in front of the camera, or outside the image are dropped.
 *
 * A view with fewer than three usable features, or with collinear ones only, is an error that names the
 * view, and the output is empty. Views are processed in parallel by vtkSMPTools; the result does not
 * depend on the number of threads.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, sections 2 and 2.1.
 *
 * @sa vtkEdgeStereoReader vtkSparseModelReader vtkFreespaceUnion vtkFreespaceSurfaceFilter
 *
 * @warning The triangles of a map are on the surface only if features lie on every edge at which depth
 * jumps or slope changes. A smooth occluding surface without texture has no such features at its outline:
 * its triangles then cut through matter.
 */
#ifndef vtkDelaunayDisparityFilter_h
#define vtkDelaunayDisparityFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkOutlierFilter.h"

namespace freespace
{
struct DisparityMapOptions;
class SharedWork;
}

class VTKFREESPACEFILTERS_EXPORT vtkDelaunayDisparityFilter : public vtkOutlierFilter
{
public:
  static vtkDelaunayDisparityFilter* New();
  vtkTypeMacro(vtkDelaunayDisparityFilter, vtkOutlierFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  // Thinning.

  ///@{
  /**
   * Side of the square cells of the image in which features of one depth become one, pixels. 0, the paper,
   * keeps all. Default 3.
   */
  vtkSetMacro(FeatureSpacing, double);
  vtkGetMacro(FeatureSpacing, double);
  ///@}

  // Disparity.

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
   * Tolerance of the minimum disparity constraint: by how much the disparity of a point may exceed that of
   * the surface, as a fraction of its disparity (to first order, of its depth). 0 in the paper, which
   * biases the surface towards the camera by the noise of the features. Default 0.0002.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Whether the lines of a view's block (edge chains) constrain the triangulation, so that no triangle
   * crosses an edge that the stereo found. Lines that intersect others are skipped. Off in the paper.
   * Default off.
   */
  vtkSetMacro(KeepEdges, vtkTypeBool);
  vtkGetMacro(KeepEdges, vtkTypeBool);
  vtkBooleanMacro(KeepEdges, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether edges of the triangulation are flipped where their triangles are badly shaped in space, so that
   * triangles join what is close on the surface, and not what is close in the image over a depth jump. Lines
   * of a view's block (edge chains) are not flipped. Off in the paper. Default on.
   */
  vtkSetMacro(SpatialFlips, vtkTypeBool);
  vtkGetMacro(SpatialFlips, vtkTypeBool);
  vtkBooleanMacro(SpatialFlips, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Number of other views whose features can be inserted into a view: half of them the next ones, the rest
   * spread over the others, so that the time grows with the number of views and not with its square. Features
   * that several views share are inserted in any case. 0, the paper, is no limit. Default 40.
   */
  vtkSetMacro(PartnerViews, int);
  vtkGetMacro(PartnerViews, int);
  ///@}

  // Background.

  ///@{
  /**
   * Whether the background is continued behind bridges that other views refute. Off in the paper.
   * Default on.
   */
  vtkSetMacro(ContinueBackground, vtkTypeBool);
  vtkGetMacro(ContinueBackground, vtkTypeBool);
  vtkBooleanMacro(ContinueBackground, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Number of other views, chosen in the same way, that can refute a bridge and tell what is behind it. 0 is no
   * limit. Default 16.
   */
  vtkSetMacro(BackgroundViews, int);
  vtkGetMacro(BackgroundViews, int);
  ///@}

  ///@{
  /**
   * Minimum angle of incidence on a bridge, degrees.
   * Default 70.
   */
  vtkSetMacro(GrazingAngle, double);
  vtkGetMacro(GrazingAngle, double);
  ///@}

  ///@{
  /**
   * Minimum number of other views that must see through a bridge to refute it. Default 1.
   */
  vtkSetMacro(RefutingViews, int);
  vtkGetMacro(RefutingViews, int);
  ///@}

  // Trim.

  ///@{
  /**
   * Maximum edge length of a triangle in the image, pixels; a longer one claims no free space. 0, the
   * default and the paper, is no limit.
   */
  vtkSetMacro(LongestEdge, double);
  vtkGetMacro(LongestEdge, double);
  ///@}

  ///@{
  /**
   * Maximum ratio of the depths of a triangle's farthest and nearest corners, above 1; a triangle with a
   * greater one claims no free space. 0, the default and the paper, is no limit.
   */
  vtkSetMacro(GreatestDepthRatio, double);
  vtkGetMacro(GreatestDepthRatio, double);
  ///@}

  /**
   * What shares the work out among several processes, each of which updates a filter like this one with the same
   * input, within its Together; all get the same output. For C++; it must outlive the update. Default: none.
   */
  void SetSharedWork(freespace::SharedWork* work) { this->Shared = work; }

protected:
  vtkDelaunayDisparityFilter();
  ~vtkDelaunayDisparityFilter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  // Defaults are those of freespace::DisparityMapOptions.
  double FeatureSpacing;
  vtkTypeBool MinimumDisparity;
  double Tolerance;
  vtkTypeBool KeepEdges;
  vtkTypeBool SpatialFlips;
  int PartnerViews;
  vtkTypeBool ContinueBackground;
  int BackgroundViews;
  double GrazingAngle;
  int RefutingViews;
  double LongestEdge;
  double GreatestDepthRatio;

private:
  freespace::DisparityMapOptions Options() const;

  freespace::SharedWork* Shared = nullptr;

  vtkDelaunayDisparityFilter(const vtkDelaunayDisparityFilter&) = delete;
  void operator=(const vtkDelaunayDisparityFilter&) = delete;
};

#endif
