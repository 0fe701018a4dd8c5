// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFeatureSupportFilter
 * @brief drop features without support in their image neighbourhood
 *
 * The paper (end of section 2.2) overcomes outliers "by insisting that the recovered features have a
 * requisite amount of support in a local neighborhood of the image". This filter does so with a
 * neighbourhood of fixed radius. The outliers step of vtkDelaunayDisparityFilter, whose neighbourhood
 * follows the density of the features, usually makes it unnecessary.
 *
 * A feature is kept when at least MinimumNeighbors other features of its view lie within Radius pixels of
 * it and their disparities (1 / depth) differ from its own by at most DisparityTolerance, a fraction of
 * the greater of the two. Features that are not finite or not in front of their camera are always dropped.
 *
 * Input and output: a vtkMultiBlockDataSet of views (see the README for the arrays). All point data arrays
 * pass; the output has in addition the integer point data array `Support`, the number of neighbours with a
 * similar disparity. Lines (edge chains) pass where both ends are kept. A block that is not a view is an
 * error that names it and what it lacks, and the output is empty.
 *
 * @sa vtkDelaunayDisparityFilter vtkSparseModelReader
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
   * If positive, the radius is this multiple of the mean distance between features of a view instead of
   * Radius pixels: 2 covers about 12 features at any density. Default 0.
   */
  vtkSetMacro(RadiusInSpacings, double);
  vtkGetMacro(RadiusInSpacings, double);
  ///@}

  ///@{
  /**
   * Minimum number of neighbours with a similar disparity. 0, the default, keeps every finite feature.
   */
  vtkSetMacro(MinimumNeighbors, int);
  vtkGetMacro(MinimumNeighbors, int);
  ///@}

  ///@{
  /**
   * Maximum difference of similar disparities, as a fraction of the greater one. Default 0.01.
   */
  vtkSetMacro(DisparityTolerance, double);
  vtkGetMacro(DisparityTolerance, double);
  ///@}

protected:
  vtkFeatureSupportFilter();
  ~vtkFeatureSupportFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
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
