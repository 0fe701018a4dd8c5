// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCameraReader.h"

#include "Execution/AlgorithmErrors.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Scene/Scene.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <filesystem>

vtkStandardNewMacro(vtkCameraReader);

namespace
{

std::string WithoutEnding(const std::string& image)
{
  return std::filesystem::path(image).replace_extension().string();
}

}

vtkCameraReader::vtkCameraReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkCameraReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    unsigned int index = 0;
    for (const freespace::CalibratedImage& image : freespace::ReadCameras(this->FileName))
    {
      freespace::View view;
      view.name = view.imageFile = image.file;
      view.camera = image.camera;
      freespace::SetNamedBlock(output, index++, view.name, freespace::BlockFromView(view));
    }
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
  return 1;
}

vtkPolyData* vtkCameraReader::GetView(const std::string& image)
{
  vtkMultiBlockDataSet* output = this->GetOutput();
  vtkPolyData* alike = nullptr;
  int count = 0;
  for (unsigned int i = 0; i < output->GetNumberOfBlocks(); ++i)
  {
    const std::string name = freespace::BlockName(output, i);
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(i));
    if (name == image)
    {
      return block;
    }
    if (WithoutEnding(name) == image)
    {
      alike = block;
      ++count;
    }
  }
  return count == 1 ? alike : nullptr;
}

void vtkCameraReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
