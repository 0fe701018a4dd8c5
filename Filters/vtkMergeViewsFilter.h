// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMergeViewsFilter
 * @brief merge the features of several sources into one set of views
 *
 * Structure from motion recovers isolated points, edge stereo recovers edges. Where both cover the same
 * image, their features belong in one disparity map, so that each bounds the free space that the other
 * claims.
 *
 * Input: any number of vtkMultiBlockDataSet of views on one port (AddInputConnection). Views of the same
 * image and the same camera are merged into one, whatever their names; it has the name of the first. All
 * other views pass unchanged. Output: the views in the order of their first appearance.
 *
 * A merged view has the point data arrays that all its parts have with the same type and number of
 * components; lines (edge chains) pass; the field data are those of the first part. A block that is not a
 * view is an error that names it and what it lacks, and the output is empty.
 *
 * @sa vtkEdgeStereoReader vtkSparseModelReader vtkDelaunayDisparityFilter
 */
#ifndef vtkMergeViewsFilter_h
#define vtkMergeViewsFilter_h

#include "vtkFreespaceFiltersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKFREESPACEFILTERS_EXPORT vtkMergeViewsFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkMergeViewsFilter* New();
  vtkTypeMacro(vtkMergeViewsFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkMergeViewsFilter() = default;
  ~vtkMergeViewsFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMergeViewsFilter(const vtkMergeViewsFilter&) = delete;
  void operator=(const vtkMergeViewsFilter&) = delete;
};

#endif
