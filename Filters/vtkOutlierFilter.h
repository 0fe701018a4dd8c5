// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOutlierFilter
 * @brief drop outliers among the features of views
 *
 * The paper (end of section 2.2) overcomes outliers "by insisting that the recovered features have a
 * requisite amount of support in a local neighborhood of the image". A feature is dropped when fewer than Support
 * features in its neighbourhood have a similar disparity (1 / depth); and, beyond the paper, when it is in the free
 * space of SeeThroughViews other views, or behind triangles that ViolatingFeatures features of other views violate.
 * Features in no triangle, with a SupportRadius those that are not finite or not in front of their camera, are
 * dropped, too. A view that would keep fewer than three features keeps all.
 *
 * This is the outliers step of vtkDelaunayDisparityFilter, by the same settings, alone: for features that are wanted
 * themselves, and for isolated points (SupportRadius 2) before they are merged with others.
 *
 * Input and output: a vtkMultiBlockDataSet of views (see the README for the arrays). All point data arrays
 * pass. Lines (edge chains) pass where both ends are kept. A block that is not a view, and a view with fewer than
 * three usable features where views are triangulated, are errors that name it, and the output is empty.
 *
 * @sa vtkDelaunayDisparityFilter vtkSparseModelReader
 */
#ifndef vtkOutlierFilter_h
#define vtkOutlierFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

namespace freespace
{
struct OutlierOptions;
}

class VTKFREESPACEFILTERS_EXPORT vtkOutlierFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkOutlierFilter* New();
  vtkTypeMacro(vtkOutlierFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Minimum number of features in the neighbourhood of a feature with a similar disparity; 0 keeps all. Default 2.
   */
  vtkSetMacro(Support, int);
  vtkGetMacro(Support, int);
  ///@}

  ///@{
  /**
   * A feature that at least this number of views have at exactly the same place, as the views of a
   * structure-from-motion model have, needs no support; 0: all need it, otherwise at least 2. Default 3.
   */
  vtkSetMacro(SharingViews, int);
  vtkGetMacro(SharingViews, int);
  ///@}

  ///@{
  /**
   * The neighbourhood. 0, the default: the six nearest features in the image, within two triangles. Otherwise the
   * features within so many mean distances between the features of the view: 2, for isolated points, has about 12.
   */
  vtkSetMacro(SupportRadius, double);
  vtkGetMacro(SupportRadius, double);
  ///@}

  ///@{
  /**
   * Maximum difference of similar disparities within SupportRadius, as a fraction of the greater one. Default 0.05.
   */
  vtkSetMacro(SupportTolerance, double);
  vtkGetMacro(SupportTolerance, double);
  ///@}

  ///@{
  /**
   * A feature is dropped if it is in the free space of at least this number of other views, and of more than
   * have it on their surface. 0, the default and the paper, drops none.
   */
  vtkSetMacro(SeeThroughViews, int);
  vtkGetMacro(SeeThroughViews, int);
  ///@}

  ///@{
  /**
   * A triangle is wrong if at least this number of supported features of other views violate the constraint
   * on it, and more than lie on it. A feature is dropped, before the constraint is enforced, if it is the
   * farthest corner of wrong triangles over most of the angle around it. 0, the default and the paper,
   * drops none.
   */
  vtkSetMacro(ViolatingFeatures, int);
  vtkGetMacro(ViolatingFeatures, int);
  ///@}

protected:
  vtkOutlierFilter();
  ~vtkOutlierFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  freespace::OutlierOptions Outliers() const;

  // Defaults are those of freespace::OutlierOptions.
  int Support;
  int SharingViews;
  double SupportRadius;
  double SupportTolerance;
  int SeeThroughViews;
  int ViolatingFeatures;

private:
  vtkOutlierFilter(const vtkOutlierFilter&) = delete;
  void operator=(const vtkOutlierFilter&) = delete;
};

#endif
