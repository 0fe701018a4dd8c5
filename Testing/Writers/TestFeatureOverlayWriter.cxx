// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureOverlayWriter.h"

#include "Support/ErrorObserver.h"
#include "Support/Scenes/SquaresScene.h"
#include "vtkEdgeStereoReader.h"

#include <vtkCommand.h>
#include <vtkNew.h>

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace freespace;

TEST(FeatureOverlayWriter, DrawsOnePicturePerView)
{
  const SquaresScene scene(2);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  vtkNew<vtkFeatureOverlayWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetImagesFolder(scene.Folder.Path("images"));
  writer->SetOutputFolder(scene.Folder.Path("new/overlay"));
  ASSERT_EQ(writer->Write(), 1);
  for (const char* name : { "new/overlay/cluster0.png", "new/overlay/cluster1.png" })
  {
    const cv::Mat picture = cv::imread(scene.Folder.Path(name));
    ASSERT_EQ(picture.cols, 240) << name;
    ASSERT_EQ(picture.rows, 180) << name;
    int bright = 0; // the picture itself is darkened to 0.4 of 220 at most
    for (auto pixel = picture.begin<cv::Vec3b>(); pixel != picture.end<cv::Vec3b>(); ++pixel)
    {
      bright += std::max({ (*pixel)[0], (*pixel)[1], (*pixel)[2] }) > 100;
    }
    EXPECT_GT(bright, 700) << name;
    EXPECT_LT(bright, 6000) << name;
  }
}

TEST(FeatureOverlayWriter, MissingPicture)
{
  const SquaresScene scene(1);
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff(); // views of the references alone
  reader->SetFileName(scene.File);
  vtkNew<vtkFeatureOverlayWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetImagesFolder(scene.Folder.Path("elsewhere"));
  writer->SetOutputFolder(scene.Folder.Path("overlay"));
  vtkNew<ErrorObserver> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(errors->Has("c.png")) << errors->All;
  EXPECT_FALSE(std::filesystem::exists(scene.Folder.Path("overlay/cluster0.png")));
}
