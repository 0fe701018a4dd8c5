// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMergeViewsFilter
 * @brief put features from several sources into one set of views
 *
 * Structure from motion gives isolated points, edge stereo gives edges: where both saw the same image,
 * their features belong into one disparity map, since there each limits what the other would carve.
 *
 * Input: any number of vtkMultiBlockDataSet of views on one port (AddInputConnection). Views of one
 * image and the same camera, whatever their names, become one view, named as the first of them; all
 * others pass as they are. Output: the views in the order of their first appearance.
 *
 * Of a view that was merged only the point data arrays pass that all its parts have, with the same
 * type and number of components; lines (edge chains) pass; field data is the first part's. A block
 * that is not a view is an error: the filter says which and what it lacks, and its output is empty.
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
