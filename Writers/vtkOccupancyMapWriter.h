// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOccupancyMapWriter
 * @brief write the free space of triangulated views as an OctoMap
 *
 * Input: a vtkMultiBlockDataSet of disparity maps. Their Phi' (see vtkFreespaceUnion) is evaluated at the
 * centre of each cell of a lattice over the hull, which is aligned to OctoMap's: the cell is free where it
 * is positive, and occupied elsewhere. A cell that no view observes, because its centre is outside all
 * triangles of every map or behind the camera, is unknown. Equal cells are pruned to larger ones.
 *
 * A .bt stores free and occupied in two bits per node; an .ot also stores probabilities, which are
 * OctoMap's clamping thresholds (0.12 and 0.97). Lengths are in the unit of the camera model.
 *
 * The file is written beside its target and renamed. Another extension, invalid or empty maps, settings
 * out of range, a resolution with more than 65,536 cells along a side or a billion in all, and a folder
 * that cannot be written are errors that name the file; Write() then returns 0.
 *
 * @sa vtkDelaunayDisparityFilter vtkFreespaceUnion
 */
#ifndef vtkOccupancyMapWriter_h
#define vtkOccupancyMapWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
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
   * The file to write; its extension (.bt or .ot) determines the format.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Side of the smallest cells; a negative one is an error. Default 0: 1/128 of the longest side of the hull's
   * bounding box.
   */
  vtkSetMacro(Resolution, double);
  vtkGetMacro(Resolution, double);
  ///@}

  ///@{
  /**
   * Subtracted from all coordinates: an OctoMap reaches 32,768 cells from its origin, and is read in single precision. A
   * comment in the file's header tells it: "# global shift X Y Z". Default 0, 0, 0. AutomaticGlobalShift, default
   * off, chooses it by the hull, as vtkSurfaceWriter::SuggestGlobalShift does.
   */
  vtkSetVector3Macro(GlobalShift, double);
  vtkGetVector3Macro(GlobalShift, double);
  vtkSetMacro(AutomaticGlobalShift, vtkTypeBool);
  vtkGetMacro(AutomaticGlobalShift, vtkTypeBool);
  vtkBooleanMacro(AutomaticGlobalShift, vtkTypeBool);
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
   * See vtkFreespaceUnion::SetContradiction. Default 1.
   */
  vtkSetMacro(Contradiction, double);
  vtkGetMacro(Contradiction, double);
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
  double GlobalShift[3] = { 0, 0, 0 };
  vtkTypeBool AutomaticGlobalShift = false;
  // Defaults are those of freespace::FreespaceUnionOptions.
  double HullMargin;
  int MinimumViews;
  double Contradiction;
  int RegionMode = 0;
  double Region[6] = { 1, -1, 1, -1, 1, -1 };

private:
  vtkOccupancyMapWriter(const vtkOccupancyMapWriter&) = delete;
  void operator=(const vtkOccupancyMapWriter&) = delete;
};

#endif
