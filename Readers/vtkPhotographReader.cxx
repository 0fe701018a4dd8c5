// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographReader.h"

#include "Files/PathChecks.h"
#include "Data/ViewBlocks.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Images/UndistortedImage.h"
#include "Scene/Scene.h"

#include <vtkCompositeDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <opencv2/imgproc.hpp>

#include <filesystem>

vtkStandardNewMacro(vtkPhotographReader);

namespace
{

vtkSmartPointer<vtkImageData> ImageDataOf(const cv::Mat& image)
{
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(image.cols, image.rows, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  cv::Mat upsideDown(image.rows, image.cols, CV_8UC3, data->GetScalarPointer());
  cv::flip(image, upsideDown, 0);
  cv::cvtColor(upsideDown, upsideDown, cv::COLOR_BGR2RGB);
  return data;
}

}

vtkPhotographReader::vtkPhotographReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkPhotographReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    const freespace::Scene scene = freespace::ReadScene(this->FileName);
    const std::vector<freespace::CalibratedImage> images = freespace::ReadSceneImages(scene);
    unsigned int count = 0;
    for (std::size_t i = 0; i < images.size(); ++i)
    {
      const std::string path = scene.ImagePath(images[i].file);
      if (freespace::IsThere(path))
      {
        const auto data = ImageDataOf(freespace::ReadUndistortedImage(path, images[i]));
        freespace::AddCamera(data, images[i].camera, images[i].file);
        output->SetBlock(count, data);
        output->GetMetaData(count)->Set(vtkCompositeDataSet::NAME(), images[i].file.c_str());
        ++count;
      }
      progress(double(i + 1) / images.size());
    }
    if (count == 0)
    {
      throw freespace::Error(
        "The scene " + this->FileName + " has no image in " + scene.ImagesFolder() + ".");
    }
    return 1;
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
}

void vtkPhotographReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
