// SPDX-License-Identifier: BSD-3-Clause
#include "Blocks/ImageBlocks.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Images/DecodeImage.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>

#include <opencv2/imgproc.hpp>

namespace freespace
{

namespace
{

int DepthOf(int scalarType)
{
  switch (scalarType)
  {
    case VTK_UNSIGNED_CHAR:
      return CV_8U;
    case VTK_UNSIGNED_SHORT:
      return CV_16U;
    case VTK_FLOAT:
      return CV_32F;
    case VTK_DOUBLE:
      return CV_64F;
    default:
      return -1;
  }
}

cv::Mat PixelsOf(vtkImageData* image, const std::string& name)
{
  int size[3];
  image->GetDimensions(size);
  const int channels =
    image->GetPointData()->GetScalars() ? image->GetNumberOfScalarComponents() : 0;
  const int depth = channels > 0 ? DepthOf(image->GetScalarType()) : -1;
  if (depth < 0 || (channels != 1 && channels != 3 && channels != 4) || size[2] != 1)
  {
    throw Error("The image " + name +
      " is not one slice of grey or colour of unsigned char, unsigned short, float or double.");
  }
  const cv::Mat upsideDown(
    size[1], size[0], CV_MAKETYPE(depth, channels), image->GetScalarPointer());
  cv::Mat pixels;
  cv::flip(upsideDown, pixels, 0);
  const int code = channels == 1 ? cv::COLOR_GRAY2BGR
    : channels == 3              ? cv::COLOR_RGB2BGR
                                 : cv::COLOR_RGBA2BGR;
  pixels = EightBits(pixels);
  cv::cvtColor(pixels, pixels, code);
  return pixels;
}

}

std::vector<MemoryImage> ImagesFromBlocks(vtkMultiBlockDataSet* blocks)
{
  std::vector<MemoryImage> images;
  for (unsigned int i = 0; blocks && i < blocks->GetNumberOfBlocks(); ++i)
  {
    auto* block = vtkImageData::SafeDownCast(blocks->GetBlock(i));
    MemoryImage image;
    image.name = BlockName(blocks, i);
    if (!block)
    {
      throw Error("The image " + image.name + " is not a vtkImageData.");
    }
    image.camera = CameraFromBlock(block, image.name);
    image.pixels = PixelsOf(block, image.name);
    images.push_back(std::move(image));
  }
  return images;
}

}
