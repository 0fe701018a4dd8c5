// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPVFreespaceUnion
 * @brief the union of free spaces over the maps of a source of ParaView
 *
 * A proxy of ParaView can give an implicit function another proxy's algorithm, but not the output of one. Where
 * the data are distributed over several servers, each has the function of the maps that it has itself; those
 * that the plugin's readers and filters make are the same on all.
 *
 * @sa vtkFreespaceUnion vtkFreespaceSampleFilter
 */
#ifndef vtkPVFreespaceUnion_h
#define vtkPVFreespaceUnion_h

#include "vtkFreespacePhiModule.h" // for the export macro
#include "vtkFreespaceUnion.h"

class vtkAlgorithm;

class VTKFREESPACEPHI_EXPORT vtkPVFreespaceUnion : public vtkFreespaceUnion
{
public:
  static vtkPVFreespaceUnion* New();
  vtkTypeMacro(vtkPVFreespaceUnion, vtkFreespaceUnion);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Takes the maps from the first output of an algorithm; null stands for none.
   */
  void SetMapsSource(vtkAlgorithm* source);

  /**
   * Includes the source, whose changes make the next evaluation build the function again.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPVFreespaceUnion() = default;
  ~vtkPVFreespaceUnion() override = default;

private:
  vtkPVFreespaceUnion(const vtkPVFreespaceUnion&) = delete;
  void operator=(const vtkPVFreespaceUnion&) = delete;

  vtkMTimeType SourceTime = 0; ///< of the source's last change that was noticed
};

#endif
