// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFreespaceSampleFilter
 * @brief Phi as an array of the points of any data set
 *
 * ParaView's clip and slice list only its own functions in their panels; with Phi as a point array, they and
 * the contour take Phi as a scalar: negative in matter, positive in free space, 0 on the boundary.
 *
 * Input 0: any vtkDataSet, or a composite one of these. Input 1: disparity maps, as vtkDelaunayDisparityFilter
 * makes them. Output: input 0 with the point array `Phi` (double, unit of the camera model), see
 * vtkFreespaceUnion for its value.
 *
 * Maps that are not valid are an error, and the output is empty; after an abort it is empty, too.
 *
 * @sa vtkFreespaceUnion vtkPVFreespaceUnion
 */
#ifndef vtkFreespaceSampleFilter_h
#define vtkFreespaceSampleFilter_h

#include "vtkDataSetAlgorithm.h"
#include "vtkFreespacePhiModule.h" // for the export macro
#include "vtkNew.h"                // for the function

class vtkFreespaceUnion;

class VTKFREESPACEPHI_EXPORT vtkFreespaceSampleFilter : public vtkDataSetAlgorithm
{
public:
  static vtkFreespaceSampleFilter* New();
  vtkTypeMacro(vtkFreespaceSampleFilter, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of views in whose free space a point must be to be free; -1, the default, is automatic; 1 in the
   * paper. See vtkFreespaceUnion::SetMinimumViews.
   */
  void SetMinimumViews(int views);
  int GetMinimumViews();
  ///@}

  ///@{
  /**
   * Offset of the hull, as a fraction of the diagonal of the box of the features; -1, the default, is
   * slightly more than a lattice cell, or than the distance of the features where they are sparse. See vtkFreespaceUnion::SetHullMargin.
   */
  void SetHullMargin(double margin);
  double GetHullMargin();
  ///@}

protected:
  vtkFreespaceSampleFilter();
  ~vtkFreespaceSampleFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkFreespaceSampleFilter(const vtkFreespaceSampleFilter&) = delete;
  void operator=(const vtkFreespaceSampleFilter&) = delete;

  vtkNew<vtkFreespaceUnion> FreespaceUnion;
};

#endif
