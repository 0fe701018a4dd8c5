// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographBlocks.h"

#include "CameraForVTK.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>

namespace freespace
{

namespace
{

Photograph PhotographFromBlock(vtkImageData* image, const std::string& name)
{
  Photograph photograph;
  photograph.name = name;
  photograph.camera = CameraFromBlock(image, name);
  CheckCamera(photograph.camera);
  const int width = photograph.camera.width;
  const int height = photograph.camera.height;
  const int channels = image->GetNumberOfScalarComponents();
  int size[3];
  image->GetDimensions(size);
  if (image->GetScalarType() != VTK_UNSIGNED_CHAR || (channels != 3 && channels != 4) ||
    size[0] != width || size[1] != height || size[2] != 1)
  {
    throw Error("Block '" + name + "' is not an image of " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels in colour, as its camera says.");
  }
  photograph.rgb.reserve(std::size_t(3) * width * height);
  const auto* values = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (int row = height - 1; row >= 0; --row)
  {
    const unsigned char* line = values + std::size_t(row) * width * channels;
    for (int column = 0; column < width; ++column, line += channels)
    {
      photograph.rgb.insert(photograph.rgb.end(), line, line + 3);
    }
  }
  return photograph;
}

}

std::vector<Photograph> PhotographsFromBlocks(vtkMultiBlockDataSet* blocks)
{
  std::vector<Photograph> photographs;
  for (unsigned int i = 0; blocks && i < blocks->GetNumberOfBlocks(); ++i)
  {
    auto* image = vtkImageData::SafeDownCast(blocks->GetBlock(i));
    const std::string name = BlockName(blocks, i);
    if (!image)
    {
      throw Error("Block '" + name + "' is not an image.");
    }
    photographs.push_back(PhotographFromBlock(image, name));
  }
  return photographs;
}

}
