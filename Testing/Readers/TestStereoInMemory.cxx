// SPDX-License-Identifier: BSD-3-Clause
// vtkEdgeStereoReader of images that are connected, and not files.
#include "Data/ViewBlocks.h"
#include "Support/Scenes/SquaresScene.h"
#include "Support/ErrorObserver.h"
#include "vtkEdgeStereoReader.h"
#include "vtkPhotographReader.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <functional>

using namespace freespace;

namespace
{

vtkPolyData* BlockOf(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  return vtkPolyData::SafeDownCast(blocks->GetBlock(index));
}

void ExpectSameArray(vtkDataArray* a, vtkDataArray* b, const std::string& name)
{
  ASSERT_TRUE(a && b) << name;
  ASSERT_EQ(a->GetNumberOfTuples(), b->GetNumberOfTuples()) << name;
  ASSERT_EQ(a->GetNumberOfComponents(), b->GetNumberOfComponents()) << name;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      ASSERT_EQ(a->GetComponent(i, c), b->GetComponent(i, c)) << name << " of " << i;
    }
  }
}

// All arrays of numbers, points, lines and the camera.
void ExpectSameView(vtkPolyData* a, vtkPolyData* b)
{
  ExpectSameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData(), "Points");
  ExpectSameArray(
    a->GetLines()->GetConnectivityArray(), b->GetLines()->GetConnectivityArray(), "Lines");
  vtkFieldData* fields[2][2] = { { a->GetPointData(), b->GetPointData() },
    { a->GetFieldData(), b->GetFieldData() } };
  for (const auto& [one, other] : fields)
  {
    ASSERT_EQ(one->GetNumberOfArrays(), other->GetNumberOfArrays());
    for (int i = 0; i < one->GetNumberOfArrays(); ++i)
    {
      if (vtkDataArray* array = one->GetArray(i))
      {
        ExpectSameArray(array, other->GetArray(array->GetName()), array->GetName());
      }
    }
  }
}

}

// Images as a vtkPhotographReader generates them, connected to another reader with the clusters.
TEST(StereoInMemory, ImagesInMemoryGiveTheSameFeatures)
{
  const SquaresScene scene(1);
  vtkNew<vtkEdgeStereoReader> fromFiles;
  fromFiles->SetFileName(scene.File);
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(scene.File);
  vtkNew<vtkEdgeStereoReader> fromMemory;
  fromMemory->SetInputConnection(photographs->GetOutputPort());
  fromMemory->AddTriplet("cluster0", "l.png", "c.png", "r.png");
  EXPECT_EQ(ErrorOfUpdate(fromFiles), "");
  EXPECT_EQ(ErrorOfUpdate(fromMemory), "");
  vtkMultiBlockDataSet* expected = fromFiles->GetOutput();
  vtkMultiBlockDataSet* found = fromMemory->GetOutput();
  ASSERT_EQ(expected->GetNumberOfBlocks(), 3u); // every image of a small scene
  ASSERT_EQ(found->GetNumberOfBlocks(), 3u);
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(BlockName(found, i), BlockName(expected, i));
    ExpectSameView(BlockOf(found, i), BlockOf(expected, i));
  }
}

TEST(StereoInMemory, ImagesInMemoryOfMoreBits)
{
  const SquaresScene scene(1);
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(scene.File);
  photographs->Update();
  vtkMultiBlockDataSet* colors = photographs->GetOutput();
  vtkNew<vtkMultiBlockDataSet> wide; // 16 bits and alpha; 255 becomes 65535
  for (unsigned int i = 0; i < colors->GetNumberOfBlocks(); ++i)
  {
    auto* image = vtkImageData::SafeDownCast(colors->GetBlock(i));
    vtkNew<vtkImageData> copy;
    copy->CopyStructure(image);
    copy->GetFieldData()->ShallowCopy(image->GetFieldData());
    copy->AllocateScalars(VTK_UNSIGNED_SHORT, 4);
    vtkDataArray* from = image->GetPointData()->GetScalars();
    vtkDataArray* to = copy->GetPointData()->GetScalars();
    for (vtkIdType k = 0; k < to->GetNumberOfTuples(); ++k)
    {
      for (int c = 0; c < 4; ++c)
      {
        to->SetComponent(k, c, c < 3 ? 257 * from->GetComponent(k, c) : 65535);
      }
    }
    wide->SetBlock(i, copy);
    wide->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), BlockName(colors, i).c_str());
  }
  vtkMultiBlockDataSet* outputs[2];
  vtkNew<vtkEdgeStereoReader> readers[2];
  for (int k = 0; k < 2; ++k)
  {
    readers[k]->SetInputDataObject(k == 0 ? colors : wide.Get());
    readers[k]->AddTriplet("a", "l.png", "c.png", "r.png");
    EXPECT_EQ(ErrorOfUpdate(readers[k]), "");
    outputs[k] = readers[k]->GetOutput();
  }
  ASSERT_EQ(outputs[0]->GetNumberOfBlocks(), outputs[1]->GetNumberOfBlocks());
  ExpectSameView(BlockOf(outputs[0], 0), BlockOf(outputs[1], 0));
}

TEST(StereoInMemory, FaultsOfImagesInMemoryAreNamed)
{
  const SquaresScene scene(1);
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(scene.File);
  photographs->Update();
  using Change = std::function<void(vtkEdgeStereoReader*, vtkMultiBlockDataSet*)>;
  const auto field = [](vtkMultiBlockDataSet* blocks, const char* name) {
    return vtkDataArray::SafeDownCast(blocks->GetBlock(1)->GetFieldData()->GetAbstractArray(name));
  };
  const std::pair<const char*, Change> faults[] = {
    { "two images are called|Two images are called c.png",
      [](vtkEdgeStereoReader*, vtkMultiBlockDataSet* blocks)
      { blocks->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "c.png"); } },
    { "no file name|there is the scene there.json",
      [](vtkEdgeStereoReader* reader, vtkMultiBlockDataSet*)
      { reader->SetFileName("there.json"); } },
    { "a known image|names an image that is not there, x.png",
      [](vtkEdgeStereoReader* reader, vtkMultiBlockDataSet*)
      { reader->AddTriplet("b", "l.png", "c.png", "x.png"); } },
    { "one reference|does not have the reference c.png in its middle",
      [](vtkEdgeStereoReader* reader, vtkMultiBlockDataSet*)
      { reader->AddTriplet("a", "c.png", "l.png", "r.png"); } },
    { "three images|has an image twice",
      [](vtkEdgeStereoReader* reader, vtkMultiBlockDataSet*)
      { reader->AddTriplet("a", "l.png", "c.png", "l.png"); } },
    { "an image|The image l.png is not a vtkImageData",
      [](vtkEdgeStereoReader*, vtkMultiBlockDataSet* blocks)
      { blocks->SetBlock(1, vtkNew<vtkPolyData>()); } },
    { "its camera's size|The image l.png has 240 x 180 pixels, but its camera has 239 x 180",
      [&](vtkEdgeStereoReader*, vtkMultiBlockDataSet* blocks)
      { field(blocks, "ImageSize")->SetComponent(0, 0, 239); } },
    { "a rotation|View 'l.png' has a pose that does not begin with a rotation",
      [&](vtkEdgeStereoReader*, vtkMultiBlockDataSet* blocks)
      { field(blocks, "CameraFromWorld")->SetComponent(0, 0, 2); } },
    { "a pinhole|The image l.png has intrinsics with a skew",
      [&](vtkEdgeStereoReader*, vtkMultiBlockDataSet* blocks)
      { field(blocks, "CameraIntrinsics")->SetComponent(0, 1, 2); } },
  };
  for (const auto& [text, change] : faults)
  {
    const std::string wanted = std::string(text).substr(std::string(text).find('|') + 1);
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->DeepCopy(photographs->GetOutput());
    vtkNew<vtkEdgeStereoReader> reader;
    reader->SetInputDataObject(blocks);
    reader->AddTriplet("a", "l.png", "c.png", "r.png");
    change(reader, blocks);
    EXPECT_NE(ErrorOfUpdate(reader).find(wanted), std::string::npos) << text;
    EXPECT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 0u) << text;
  }
  vtkNew<vtkEdgeStereoReader> none;
  none->AddTriplet("a", "l.png", "c.png", "r.png");
  EXPECT_NE(ErrorOfUpdate(none).find("no images are connected"), std::string::npos);
}
