// SPDX-License-Identifier: BSD-3-Clause
// Masks as free space: vtkEdgeStereoReader with MaskIsFree.
#include "Common/Camera.h"
#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Support/Scenes/SquaresScene.h"
#include "vtkDelaunayDisparityFilter.h"
#include "vtkEdgeStereoReader.h"
#include "vtkFreespaceUnion.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPolyData.h>

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

using namespace freespace;

namespace
{

// The squares, of which the middle of each image is to be ignored.
class MaskedScene : public SquaresScene
{
public:
  MaskedScene()
    : SquaresScene(1)
  {
    std::filesystem::create_directories(this->Folder.Path("masks"));
    for (const char* name : { "c", "l", "r" })
    {
      cv::Mat mask(180, 240, CV_8U, cv::Scalar(255));
      mask(cv::Rect(100, 70, 40, 40)) = 0;
      cv::imwrite(this->Folder.Path("masks/" + std::string(name) + ".png.png"), mask);
    }
    this->File = this->Folder.Write("masked.json",
      R"({ "images": "images", "model": "sparse", "masks": "masks", "clusters": [
        { "name": "cluster0", "reference": "c.png", "triplets": [["l.png", "c.png", "r.png"]] }] })");
  }
};

}

TEST(Silhouettes, OfAllImagesFollowTheViews)
{
  const MaskedScene scene;
  vtkNew<vtkEdgeStereoReader> reader;
  reader->EveryImageOff();
  reader->SetFileName(scene.File);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 1u) << "only if asked for";
  reader->MaskIsFreeOn();
  reader->Update();
  vtkMultiBlockDataSet* blocks = reader->GetOutput();
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 4u);
  EXPECT_EQ(NumberOfSilhouettes(blocks), 3u);
  EXPECT_EQ(BlockName(blocks, 1), "c.png (mask)");
  const DisparityMap map = MapFromBlocks(blocks, 1);
  double area = 0;
  for (const auto& [a, b, c] : map.triangles)
  {
    const Eigen::Vector2d ab = map.imagePoints[b] - map.imagePoints[a];
    const Eigen::Vector2d ac = map.imagePoints[c] - map.imagePoints[a];
    area += std::abs(ab.x() * ac.y() - ab.y() * ac.x()) / 2;
  }
  EXPECT_NEAR(area, 37 * 37, 1e-6); // between the pixels' centres, without a margin of one pixel
}

TEST(Silhouettes, AreFreeInTheUnion)
{
  const MaskedScene scene;
  const auto isFree = [&scene](bool masks)
  {
    vtkNew<vtkEdgeStereoReader> reader;
    reader->SetFileName(scene.File);
    reader->SetMaskIsFree(masks);
    vtkNew<vtkDelaunayDisparityFilter> maps;
    maps->SetInputConnection(reader->GetOutputPort());
    maps->Update();
    vtkNew<vtkFreespaceUnion> phi;
    phi->SetMaps(maps->GetOutput());
    phi->SetHullMargin(0.05);
    // A little behind the plane of the squares, where the middle of the reference looks.
    const Camera camera = MapFromBlocks(maps->GetOutput(), 0).camera;
    const Eigen::Vector3d feature = MapFromBlocks(maps->GetOutput(), 0).points.front();
    const Eigen::Vector3d point = camera.Unproject({ 120, 90 }, camera.Depth(feature) * 1.005);
    return phi->EvaluateFunction(point.x(), point.y(), point.z()) > 0;
  };
  EXPECT_FALSE(isFree(false));
  EXPECT_TRUE(isFree(true));
}

TEST(Silhouettes, NeedMasks)
{
  const SquaresScene scene(1);
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkEdgeStereoReader> reader;
  reader->SetFileName(scene.File);
  reader->MaskIsFreeOn();
  reader->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_NE(reader->GetErrorCode(), vtkErrorCode::NoError);
}
