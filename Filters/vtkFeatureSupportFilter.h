// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFeatureSupportFilter
 * @brief drop features that have no support in their image neighbourhood
 *
 * One outlier in front of the scene spoils the disparity map of every other view through the minimum
 * disparity constraint. The paper (end of section 2.2) overcomes them "by insisting that the
 * recovered features have a requisite amount of support in a local neighborhood of the image".
 *
 * A feature is kept when at least MinimumNeighbors other features of its view lie within Radius
 * pixels of it and agree with its disparity (1 / depth) to within DisparityTolerance, a fraction of
 * the greater of the two disparities. Features that are not finite or not in front of their camera
 * are always dropped.
 *
 * Input and output: a vtkMultiBlockDataSet of views (see the README for the arrays). All point data
 * arrays pass; the output has the integer point data array `Support`, the number of agreeing
 * neighbours. Lines (edge chains) pass where both ends survive.
 * A block that is not a view is an error: the filter says which and what it lacks, and its output is
 * empty.
 */
#ifndef vtkFeatureSupportFilter_h
#define vtkFeatureSupportFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkFeatureSupportFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkFeatureSupportFilter* New();
  vtkTypeMacro(vtkFeatureSupportFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Radius of the neighbourhood in pixels. Default 4.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * When positive, the radius is so many times the mean distance of a view's features instead of
   * Radius pixels: 2 takes in about 12 of them, however sparse they are. Default 0.
   */
  vtkSetMacro(RadiusInSpacings, double);
  vtkGetMacro(RadiusInSpacings, double);
  ///@}

  ///@{
  /**
   * How many neighbours must agree. 0, the default, keeps every finite feature.
   */
  vtkSetMacro(MinimumNeighbors, int);
  vtkGetMacro(MinimumNeighbors, int);
  ///@}

  ///@{
  /**
   * How far the disparities of two features that agree may differ, as a fraction. Default 0.01.
   */
  vtkSetMacro(DisparityTolerance, double);
  vtkGetMacro(DisparityTolerance, double);
  ///@}

protected:
  vtkFeatureSupportFilter();
  ~vtkFeatureSupportFilter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  // Defaults are those of freespace::FeatureSupportOptions.
  double Radius;
  double RadiusInSpacings;
  int MinimumNeighbors;
  double DisparityTolerance;

private:
  vtkFeatureSupportFilter(const vtkFeatureSupportFilter&) = delete;
  void operator=(const vtkFeatureSupportFilter&) = delete;
};

#endif
