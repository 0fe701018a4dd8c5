// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthMapReader.h"

#include "Data/ViewBlocks.h"
#include "Depth/DepthFeatures.h"
#include "SparseModel/ColmapModel.h"
#include "Support/DepthMapBytes.h"
#include "Support/ErrorObserver.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

constexpr int width = 8, height = 6;

std::vector<float> Depths()
{
  std::vector<float> depths;
  for (int i = 0; i < width * height; ++i)
  {
    depths.push_back(1 + 0.25F * static_cast<float>(i % 7));
  }
  return depths;
}

// The bottom row first.
vtkSmartPointer<vtkImageData> ImageDataOf(const std::vector<float>& depths)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      image->SetScalarComponentFromFloat(
        column, height - 1 - row, 0, 0, depths[static_cast<std::size_t>(row) * width + column]);
    }
  }
  return image;
}

std::string WriteModel(const TemporaryFolder& folder)
{
  WriteColmapModel(MakeSyntheticModel(3, 0), folder.Path("model"), ColmapFormat::Text);
  return folder.Path("model");
}

}

TEST(vtkDepthMapReader, FilesAndImagesInMemoryAreTheSameViews)
{
  const TemporaryFolder folder;
  vtkNew<vtkDepthMapReader> reader;
  reader->SetFileName(WriteModel(folder));
  reader->AddDepthFile(
    folder.Write("image0.jpg.geometric.bin", ColmapDepthBytes(width, height, Depths())));
  reader->AddDepthFile(folder.Write("image1.pfm", PfmBytes(width, height, Depths(), false)));
  reader->AddDepthImage("image2.jpg", ImageDataOf(Depths()));
  reader->SetLargestBlock(1);
  reader->SetScale(2);
  reader->SetDeviation(0.125);
  ASSERT_EQ(ErrorOfUpdate(reader), "");
  vtkMultiBlockDataSet* output = reader->GetOutput();
  ASSERT_EQ(output->GetNumberOfBlocks(), 3u);
  const std::vector<CalibratedImage> images =
    CalibratedImages(ReadColmapModel(folder.Path("model")));
  DepthOptions options;
  options.largestBlock = 1;
  options.scale = 2;
  options.deviation = 0.125;
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(BlockName(output, i), images[i].file);
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(i));
    const View view = ViewFromBlock(block, images[i].file);
    const View expected = FeaturesOfDepthMap(images[i], { width, height, Depths() }, options);
    EXPECT_EQ(view.points, expected.points);
    EXPECT_EQ(view.imagePoints, expected.imagePoints);
    EXPECT_EQ(view.imageFile, images[i].file);
    vtkDataArray* deviations = block->GetPointData()->GetArray("DisparityDeviation");
    ASSERT_TRUE(deviations);
    for (vtkIdType k = 0; k < deviations->GetNumberOfTuples(); ++k)
    {
      EXPECT_EQ(deviations->GetComponent(k, 0), expected.deviations[static_cast<std::size_t>(k)]);
    }
  }
}

TEST(vtkDepthMapReader, BadInputIsAnErrorThatNamesIt)
{
  const TemporaryFolder folder;
  const std::string model = WriteModel(folder);
  const std::string good = folder.Write("image0.pfm", PfmBytes(width, height, Depths(), false));
  const std::string twice =
    folder.Write("image0.jpg.pfm", PfmBytes(width, height, Depths(), false));
  const std::string none =
    folder.Write("image1.pfm", PfmBytes(width, height, std::vector<float>(width * height), false));
  const std::string shape = folder.Write("image2.pfm", PfmBytes(height, width, Depths(), false));
  const std::pair<std::vector<std::string>, std::string> cases[] = {
    { { good, folder.Path("image1.jpg.pfm") }, "image1.jpg.pfm" },
    { { good, twice }, "two depth maps" }, { { good, none }, "no depth" },
    { { good, shape }, "another shape" }, { { folder.Path("x.pfm") }, "x.pfm" }
  };
  for (const auto& [files, word] : cases)
  {
    vtkNew<vtkDepthMapReader> reader;
    reader->SetFileName(model);
    for (const std::string& file : files)
    {
      reader->AddDepthFile(file);
    }
    const std::string error = ErrorOfUpdate(reader);
    EXPECT_NE(error.find(word), std::string::npos) << error;
    EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
  }
  vtkNew<vtkDepthMapReader> reader;
  reader->SetFileName(model);
  reader->AddDepthImage("absent.jpg", ImageDataOf(Depths()));
  EXPECT_NE(ErrorOfUpdate(reader).find("absent.jpg"), std::string::npos);
  reader->RemoveAllDepths();
  reader->AddDepthFile(good);
  reader->SetScale(-1);
  EXPECT_NE(ErrorOfUpdate(reader).find("scale"), std::string::npos);
}
