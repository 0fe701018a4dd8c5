// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPVTextureBaker
 * @brief bake a texture for a surface from images of a second input
 *
 * vtkTextureBaker as a filter of ParaView, which gives data sets by connections only. Input 0: the surface. Input 1:
 * the images, as vtkPhotographReader makes them. Outputs are those of vtkTextureBaker.
 *
 * @sa vtkTextureBaker vtkPhotographReader
 */
#ifndef vtkPVTextureBaker_h
#define vtkPVTextureBaker_h

#include "vtkFreespaceRenderingModule.h" // for the export macro
#include "vtkTextureBaker.h"

class VTKFREESPACERENDERING_EXPORT vtkPVTextureBaker : public vtkTextureBaker
{
public:
  static vtkPVTextureBaker* New();
  vtkTypeMacro(vtkPVTextureBaker, vtkTextureBaker);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPVTextureBaker();
  ~vtkPVTextureBaker() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPVTextureBaker(const vtkPVTextureBaker&) = delete;
  void operator=(const vtkPVTextureBaker&) = delete;
};

#endif
