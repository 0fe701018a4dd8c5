// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCameraReader.h"

#include "Data/ViewBlocks.h"
#include "SparseModel/ColmapModel.h"
#include "Support/ErrorObserver.h"
#include "Support/SyntheticModel.h"
#include "Support/TemporaryFolder.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

void ExpectCamera(vtkPolyData* block, const CalibratedImage& image)
{
  ASSERT_TRUE(block) << image.file;
  const View view = ViewFromBlock(block, image.file);
  EXPECT_EQ(view.imageFile, image.file);
  EXPECT_EQ(view.camera.K, image.camera.K);
  EXPECT_EQ(view.camera.R, image.camera.R);
  EXPECT_EQ(view.camera.t, image.camera.t);
  EXPECT_EQ(view.camera.width, image.camera.width);
  EXPECT_EQ(view.camera.height, image.camera.height);
  EXPECT_TRUE(view.points.empty());
}

}

TEST(vtkCameraReader, CamerasOfAModel)
{
  const TemporaryFolder folder;
  const SparseModel model = MakeSyntheticModel(4, 30);
  WriteColmapModel(model, folder.Path("sparse"), ColmapFormat::Text);
  vtkNew<vtkCameraReader> reader;
  reader->SetFileName(folder.Path("sparse"));
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 4u);
  for (const CalibratedImage& image : CalibratedImages(ReadColmapModel(folder.Path("sparse"))))
  {
    ExpectCamera(reader->GetView(image.file), image);
  }
}

TEST(vtkCameraReader, CamerasOfAScene)
{
  const TemporaryFolder folder;
  WriteColmapModel(MakeSyntheticModel(3, 30), folder.Path("sparse"), ColmapFormat::Binary);
  vtkNew<vtkCameraReader> reader;
  reader->SetFileName(folder.Write("scene.json", R"({ "images": "absent", "model": "sparse" })"));
  EXPECT_EQ(ErrorOfUpdate(reader), "") << "the image files are not read";
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 3u);
  EXPECT_EQ(BlockName(reader->GetOutput(), 2), "image2.jpg");
}

TEST(vtkCameraReader, ViewsByNameWithOrWithoutExtension)
{
  const TemporaryFolder folder;
  SparseModel model = MakeSyntheticModel(4, 30);
  model.images[0].name = "a.jpg";
  model.images[1].name = "a.png";
  model.images[2].name = "sub/b.jpg";
  model.images[3].name = "b.jpg";
  WriteColmapModel(model, folder.Path(), ColmapFormat::Text);
  vtkNew<vtkCameraReader> reader;
  EXPECT_EQ(reader->GetView("a.jpg"), nullptr) << "before the update";
  reader->SetFileName(folder.Path());
  reader->Update();
  EXPECT_TRUE(reader->GetView("a.jpg"));
  EXPECT_TRUE(reader->GetView("a.png"));
  EXPECT_NE(reader->GetView("a.jpg"), reader->GetView("a.png"));
  EXPECT_EQ(reader->GetView("a"), nullptr) << "ambiguous";
  EXPECT_TRUE(reader->GetView("b"));
  EXPECT_EQ(reader->GetView("b"), reader->GetView("b.jpg"));
  EXPECT_EQ(reader->GetView("sub/b"), reader->GetView("sub/b.jpg"));
  EXPECT_EQ(reader->GetView("c"), nullptr);
  EXPECT_EQ(reader->GetView(""), nullptr);
}

TEST(vtkCameraReader, BadInputIsAnErrorThatNamesTheFile)
{
  const TemporaryFolder folder;
  vtkNew<vtkCameraReader> reader;
  for (const std::string& file :
    { folder.Path("absent.json"), folder.Path(), folder.Write("scene.json", "{ \"images\": ") })
  {
    reader->SetFileName(file);
    const std::string error = ErrorOfUpdate(reader);
    EXPECT_NE(error.find(file), std::string::npos) << error;
    EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
  }
}
