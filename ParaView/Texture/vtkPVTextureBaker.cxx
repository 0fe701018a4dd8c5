// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTextureBaker.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

vtkStandardNewMacro(vtkPVTextureBaker);

vtkPVTextureBaker::vtkPVTextureBaker()
{
  this->SetNumberOfInputPorts(2);
}

int vtkPVTextureBaker::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

// The texture is of the whole surface and all images.
int vtkPVTextureBaker::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* input = inputVector[port]->GetInformationObject(0);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return 1;
}

// The images are not kept: setting them by SetPhotographs would modify the filter while it executes.
int vtkPVTextureBaker::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Photographs = vtkMultiBlockDataSet::GetData(inputVector[1]);
  const int result = this->Superclass::RequestData(request, inputVector, outputVector);
  this->Photographs = nullptr;
  return result;
}

void vtkPVTextureBaker::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
