// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthMapReader.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Depth/DepthFeatures.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Scene/Scene.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <functional>

vtkStandardNewMacro(vtkDepthMapReader);

namespace
{

/// A map with its image, to be read.
struct Task
{
  std::size_t image;
  std::string name; // for messages
  std::function<freespace::DepthMap()> read;
};

freespace::DepthMap MapOfImageData(vtkImageData* image, const std::string& name)
{
  const int* size = image->GetDimensions();
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 || image->GetNumberOfScalarComponents() != 1 ||
    !image->GetPointData()->GetScalars())
  {
    throw freespace::Error(
      "The depth map of " + name + " is not an image with one component for each pixel.");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  freespace::DepthMap map;
  map.width = size[0];
  map.height = size[1];
  map.depths.reserve(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (vtkIdType row = map.height - 1; row >= 0; --row)
  {
    for (vtkIdType column = 0; column < map.width; ++column)
    {
      map.depths.push_back(static_cast<float>(scalars->GetComponent(row * map.width + column, 0)));
    }
  }
  return map;
}

std::size_t ImageCalled(
  const std::vector<freespace::CalibratedImage>& images, const std::string& name)
{
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    if (images[i].file == name)
    {
      return i;
    }
  }
  throw freespace::Error("There is no camera of the image " + name + ", which has a depth map.");
}

void CheckOnce(
  const std::vector<Task>& tasks, const std::vector<freespace::CalibratedImage>& images)
{
  std::vector<const Task*> first(images.size(), nullptr);
  for (const Task& task : tasks)
  {
    if (first[task.image])
    {
      throw freespace::Error("The image " + images[task.image].file + " has two depth maps, " +
        first[task.image]->name + " and " + task.name + ".");
    }
    first[task.image] = &task;
  }
}

}

vtkDepthMapReader::vtkDepthMapReader()
{
  this->SetNumberOfInputPorts(0);
  const freespace::DepthOptions options;
  this->Scale = options.scale;
  this->IsRange = options.isRange;
  this->NearestDepth = options.nearest;
  this->FarthestDepth = options.farthest;
  this->Deviation = options.deviation;
  this->RelativeDeviation = options.relativeDeviation;
  this->Tolerance = options.tolerance;
  this->LargestBlock = options.largestBlock;
}

vtkDepthMapReader::~vtkDepthMapReader() = default;

void vtkDepthMapReader::AddDepthFile(const std::string& fileName)
{
  this->DepthFiles.push_back(fileName);
  this->Modified();
}

void vtkDepthMapReader::AddDepthImage(const std::string& image, vtkImageData* depths)
{
  if (!depths)
  {
    vtkErrorMacro(<< "The depth map of " << image << " is missing.");
    return;
  }
  this->DepthImages.emplace_back(image, depths);
  this->Modified();
}

void vtkDepthMapReader::RemoveAllDepths()
{
  this->DepthFiles.clear();
  this->DepthImages.clear();
  this->Modified();
}

int vtkDepthMapReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  freespace::DepthOptions options;
  options.scale = this->Scale;
  options.isRange = this->IsRange;
  options.nearest = this->NearestDepth;
  options.farthest = this->FarthestDepth;
  options.deviation = this->Deviation;
  options.relativeDeviation = this->RelativeDeviation;
  options.tolerance = this->Tolerance;
  options.largestBlock = this->LargestBlock;
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    options.Check();
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    const auto images = freespace::ReadCameras(this->FileName);
    std::vector<Task> tasks;
    for (const std::string& file : this->DepthFiles)
    {
      tasks.push_back({ freespace::ImageOfDepthMap(images, file), file,
        [file] { return freespace::ReadDepthMap(file); } });
    }
    for (const auto& [name, data] : this->DepthImages)
    {
      tasks.push_back({ ImageCalled(images, name), "one in memory",
        [name = name, data = data.Get()] { return MapOfImageData(data, name); } });
    }
    CheckOnce(tasks, images);
    for (std::size_t i = 0; i < tasks.size(); ++i)
    {
      const freespace::View view =
        freespace::FeaturesOfDepthMap(images[tasks[i].image], tasks[i].read(), options);
      if (view.points.empty())
      {
        throw freespace::Error("The depth map of " + view.name + " has no depth that is used.");
      }
      freespace::SetNamedBlock(
        output, static_cast<unsigned int>(i), view.name, freespace::BlockFromView(view));
      progress(double(i + 1) / double(tasks.size()));
    }
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkDepthMapReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Depths: " << this->DepthFiles.size() + this->DepthImages.size() << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "IsRange: " << this->IsRange << "\n";
  os << indent << "NearestDepth: " << this->NearestDepth << "\n";
  os << indent << "FarthestDepth: " << this->FarthestDepth << "\n";
  os << indent << "Deviation: " << this->Deviation << "\n";
  os << indent << "RelativeDeviation: " << this->RelativeDeviation << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "LargestBlock: " << this->LargestBlock << "\n";
}
