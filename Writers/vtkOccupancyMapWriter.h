// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOccupancyMapWriter
 * @brief write the free space of triangulated views as an OctoMap
 *
 * Input: a vtkMultiBlockDataSet of disparity maps. Their Phi' (see vtkFreespaceUnion) is asked at the
 * middle of each cell of a lattice over the pushed out hull, which is aligned to OctoMap's: where it is
 * positive the cell is free, elsewhere occupied. A cell whose middle no view looked at, because it
 * falls outside of all triangles of every view's map or behind the view, is left unknown. Cells of one
 * kind are pruned to larger ones.
 *
 * A .bt holds free and occupied in two bits a node; an .ot also holds probabilities, which are
 * OctoMap's clamping thresholds (0.12 and 0.97). Lengths are in the unit of the camera model.
 *
 * The file is written beside its target and renamed. An ending that is neither, maps that are none or
 * empty, a resolution that asks for more than 65,536 cells along a side or a billion in all, and a folder
 * that cannot be written are errors that name the file; Write() then returns 0.
 */
#ifndef vtkOccupancyMapWriter_h
#define vtkOccupancyMapWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkWriter.h"

#include <string> // for FileName

class VTKFREESPACEWRITERS_EXPORT vtkOccupancyMapWriter : public vtkWriter
{
public:
  static vtkOccupancyMapWriter* New();
  vtkTypeMacro(vtkOccupancyMapWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; its ending (.bt or .ot) chooses the format.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * Side of the smallest cells. Default 0: the longest side of the hull's box by 128.
   */
  vtkSetClampMacro(Resolution, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Resolution, double);
  ///@}

  ///@{
  /**
   * As in vtkFreespaceUnion, with its defaults. What is out of range is an error that WriteData reports.
   */
  vtkSetMacro(HullMargin, double);
  vtkGetMacro(HullMargin, double);
  vtkSetMacro(MinimumViews, int);
  vtkGetMacro(MinimumViews, int);
  ///@}

  ///@{
  /**
   * The region of interest, as in vtkFreespaceUnion. Default automatic.
   */
  vtkSetClampMacro(RegionMode, int, 0, 2);
  vtkGetMacro(RegionMode, int);
  void SetRegionModeToAutomatic() { this->SetRegionMode(0); }
  void SetRegionModeToWhole() { this->SetRegionMode(1); }
  void SetRegion(const double bounds[6]);
  vtkGetVector6Macro(Region, double);
  ///@}

protected:
  vtkOccupancyMapWriter();
  ~vtkOccupancyMapWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;
  double Resolution = 0.0;
  // Defaults are those of freespace::FreespaceUnionOptions.
  double HullMargin;
  int MinimumViews;
  int RegionMode = 0;
  double Region[6] = { 1, -1, 1, -1, 1, -1 };

private:
  vtkOccupancyMapWriter(const vtkOccupancyMapWriter&) = delete;
  void operator=(const vtkOccupancyMapWriter&) = delete;
};

#endif
