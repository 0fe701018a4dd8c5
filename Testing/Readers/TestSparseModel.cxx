// SPDX-License-Identifier: BSD-3-Clause
// vtkSparseModelReader and vtkSparseModelWriter: what one writes the other reads.
#include "vtkSparseModelReader.h"
#include "vtkSparseModelWriter.h"

#include "Data/ViewBlocks.h"
#include "SparseModel/ColmapModel.h"
#include "Support/ErrorObserver.h"
#include "Support/ExpectSameModel.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"
#include "vtkViewBlocksReader.h"
#include "vtkViewBlocksWriter.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

vtkSmartPointer<vtkSparseModelReader> ReaderWithoutLimits(const std::string& folder)
{
  auto reader = vtkSmartPointer<vtkSparseModelReader>::New();
  reader->SetFileName(folder);
  reader->CheckImagesOff();
  reader->SetMinimumTrackLength(1);
  reader->SetMaximumError(1e300);
  reader->SetMinimumAngle(0);
  reader->SetMinimumFeatures(0);
  return reader;
}

SparseModel ModelWithTwoLenses()
{
  SparseModel model = MakeSyntheticModel(4, 60, LensModel::Radial);
  model.cameras.push_back({ 9, LensModel::SimplePinhole, 640, 480, { 500, 320, 240 } });
  model.images[2].camera = 9;
  // No features in common order: the first observations of this image are not those of points.
  model.images[2].observations.insert(model.images[2].observations.begin(), { { 1, 2 } });
  for (SparsePoint& point : model.points)
  {
    for (SparseTrackElement& element : point.track)
    {
      element.observation += element.image == model.images[2].id;
    }
  }
  return model;
}

}

TEST(SparseModelReaderAndWriter, RoundTripLosesNothing)
{
  const SparseModel model = ModelWithTwoLenses();
  TemporaryFolder folder;
  WriteColmapModel(model, folder.Path("in"), ColmapFormat::Binary);
  for (const int binary : { 0, 1 })
  {
    vtkNew<vtkSparseModelWriter> writer;
    const auto reader = ReaderWithoutLimits(folder.Path("in"));
    writer->SetInputConnection(reader->GetOutputPort());
    writer->SetFileName(folder.Path("out"));
    writer->SetBinary(binary);
    ASSERT_EQ(writer->Write(), 1);
    ExpectSameModel(model, ReadColmapModel(folder.Path("out")));
  }
}

TEST(SparseModelReaderAndWriter, RoundTripThroughAFileOfViews)
{
  const SparseModel model = ModelWithTwoLenses();
  TemporaryFolder folder;
  WriteColmapModel(model, folder.Path("in"), ColmapFormat::Text);
  const auto reader = ReaderWithoutLimits(folder.Path("in"));
  vtkNew<vtkViewBlocksWriter> toFile;
  toFile->SetInputConnection(reader->GetOutputPort());
  toFile->SetFileName(folder.Path("features.vtm"));
  ASSERT_EQ(toFile->Write(), 1);
  vtkNew<vtkViewBlocksReader> fromFile;
  fromFile->SetFileName(folder.Path("features.vtm"));
  vtkNew<vtkSparseModelWriter> writer;
  writer->SetInputConnection(fromFile->GetOutputPort());
  writer->SetFileName(folder.Path("out"));
  ASSERT_EQ(writer->Write(), 1);
  ExpectSameModel(model, ReadColmapModel(folder.Path("out")));
}

TEST(SparseModelReaderAndWriter, ViewsAsDocumented)
{
  const SparseModel model = MakeSyntheticModel(4, 60);
  TemporaryFolder folder;
  WriteColmapModel(model, folder.Path(), ColmapFormat::Text);
  vtkNew<vtkSparseModelReader> reader;
  reader->SetFileName(folder.Path());
  reader->Update();
  const std::vector<View> views = ViewsFromBlocks(reader->GetOutput());
  ASSERT_EQ(views.size(), 4u);
  EXPECT_EQ(views[1].name, "image1.jpg");
  EXPECT_EQ(views[1].imageFile, "image1.jpg");
  for (const View& view : views)
  {
    EXPECT_GT(view.points.size(), 20u);
    for (std::size_t i = 0; i < view.points.size(); ++i)
    {
      EXPECT_LT((view.camera.Project(view.points[i]) - view.imagePoints[i]).norm(), 1e-9);
    }
  }
}

// Views that come from elsewhere, such as edge stereo, become a model too.
TEST(SparseModelReaderAndWriter, ViewsWithoutAModel)
{
  const SparseModel model = MakeSyntheticModel(3, 30);
  const auto images = CalibratedImages(model);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 3; ++i)
  {
    View view;
    view.name = "cluster" + std::to_string(i);
    view.imageFile = images[i].file;
    view.camera = images[i].camera;
    for (const SparsePoint& point : model.points)
    {
      view.points.push_back(point.position);
      view.imagePoints.push_back(view.camera.Project(point.position));
    }
    SetNamedBlock(blocks, i, view.name, BlockFromView(view));
  }
  TemporaryFolder folder;
  vtkNew<vtkSparseModelWriter> writer;
  writer->SetInputDataObject(blocks);
  writer->SetFileName(folder.Path());
  ASSERT_EQ(writer->Write(), 1);
  const SparseModel written = ReadColmapModel(folder.Path());
  ASSERT_EQ(written.images.size(), 3u);
  EXPECT_EQ(written.points.size(), 90u);
  EXPECT_EQ(written.images[1].name, "image1.jpg");
  const auto writtenImages = CalibratedImages(written);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(writtenImages[i].camera.R.isApprox(images[i].camera.R, 1e-14));
    EXPECT_EQ(writtenImages[i].camera.K, images[i].camera.K);
    EXPECT_EQ(writtenImages[i].camera.t, images[i].camera.t);
  }
}

TEST(SparseModelReaderAndWriter, BadInput)
{
  ExpectedErrors errors;
  vtkNew<vtkSparseModelReader> reader;
  reader->SetFileName("/no/such/model");
  reader->Update();
  EXPECT_TRUE(errors.Has("/no/such/model"));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);

  TemporaryFolder folder;
  WriteColmapModel(MakeSyntheticModel(3, 30), folder.Path("model"), ColmapFormat::Binary);
  std::filesystem::resize_file(folder.Path("model/images.bin"), 1000);
  reader->SetFileName(folder.Path("model"));
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(errors.Has("images.bin: it is truncated"));

  WriteColmapModel(MakeSyntheticModel(3, 2), folder.Path("few"), ColmapFormat::Binary);
  reader->SetFileName(folder.Path("few"));
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(errors.Has("has no image with at least 10 points"));

  WriteColmapModel(MakeSyntheticModel(3, 30), folder.Path("model"), ColmapFormat::Binary);
  reader->SetFileName(folder.Path("model"));
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 3u);
  vtkNew<vtkSparseModelWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetFileName("/no/such/folder/model");
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(errors.Has("/no/such/folder"));

  vtkNew<vtkMultiBlockDataSet> twice;
  for (unsigned int i = 0; i < 2; ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(reader->GetOutput()->GetBlock(0));
    SetNamedBlock(twice, i, "view" + std::to_string(i), block);
  }
  writer->SetInputDataObject(twice);
  writer->SetFileName(folder.Path("twice"));
  EXPECT_EQ(writer->Write(), 0) << "two views of one image";
  EXPECT_TRUE(errors.Has("a camera model has each image once"));
}

TEST(SparseModelReaderAndWriter, RecognizesModels)
{
  TemporaryFolder folder;
  EXPECT_FALSE(vtkSparseModelReader::CanReadFile(folder.Path()));
  EXPECT_FALSE(vtkSparseModelReader::CanReadFile("/a/scene.json"));
  EXPECT_TRUE(vtkSparseModelReader::CanReadFile("/a/model.nvm"));
  EXPECT_TRUE(vtkSparseModelReader::CanReadFile("/a/bundle.out"));
  WriteColmapModel(MakeSyntheticModel(3, 2), folder.Path(), ColmapFormat::Text);
  EXPECT_TRUE(vtkSparseModelReader::CanReadFile(folder.Path()));
}
