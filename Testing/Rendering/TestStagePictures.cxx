// SPDX-License-Identifier: BSD-3-Clause
// A picture of what each stage makes of one scene, and numbers that say what a picture cannot: a block of 2 x 2 x 2 on
// a board, seen by six cameras.
#include "Support/Scenes/BlockFeatures.h"
#include "Support/PictureComparison.h"
#include "Support/PlainSettings.h"
#include "Support/TemporaryFolder.h"
#include "vtkBisectionContourFilter.h"
#include "vtkDelaunayDisparityFilter.h"
#include "vtkFeatureOverlayWriter.h"
#include "vtkFreespaceUnion.h"
#include "vtkOccupancyMapWriter.h"
#include "vtkSimplifySurfaceFilter.h"
#include "vtkSurfacePicture.h"
#include "vtkTextureBaker.h"

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkMassProperties.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkSampleFunction.h>
#include <vtkUnsignedCharArray.h>

#include <octomap/octomap.h>

#include <filesystem>
#include <functional>

namespace
{

vtkSmartPointer<vtkMultiBlockDataSet> Maps()
{
  vtkNew<vtkDelaunayDisparityFilter> filter;
  filter->SetInputDataObject(BlockFeatures());
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> Contour(const std::function<void(vtkBisectionContourFilter*)>& set)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(Maps());
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->SetCells(64);
  set(contour);
  contour->Update();
  return contour->GetOutput();
}

vtkSmartPointer<vtkImageData> PictureOf(
  vtkPolyData* surface, double azimuth = -123, double elevation = 33)
{
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(surface);
  picture->UseViewpointOff();
  picture->SetSize(160, 120);
  picture->SetAzimuth(azimuth);
  picture->SetElevation(elevation);
  picture->Update();
  return picture->GetOutput();
}

// How high the surface stands above the board under (x, y): of the points within `reach` of there, the highest.
double HeightAt(vtkPolyData* surface, double x, double y, double reach = 0.25)
{
  double height = -1e9;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    if (std::hypot(point[0] - x, point[1] - y) < reach)
    {
      height = std::max(height, point[2]);
    }
  }
  return height;
}

// The number of the surface's points on the edges of the block's top.
int CountOnTopEdges(vtkPolyData* surface)
{
  int count = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    const double side = std::max(std::abs(point[0]), std::abs(point[1]));
    count += std::abs(point[2] - 2) < 0.02 && std::abs(side - 1) < 0.02;
  }
  return count;
}

}

TEST(StagePictures, DisparityMap)
{
  const auto maps = Maps();
  auto* map = vtkPolyData::SafeDownCast(maps->GetBlock(0));
  ASSERT_NE(map, nullptr);
  EXPECT_NEAR(HeightAt(map, 0, 0), 2, 1e-9);
  EXPECT_NEAR(HeightAt(map, -3, 2), 0, 1e-9);
  EXPECT_EQ(map->GetPointData()->GetArray("SourceView")->GetTuple1(0), 0);
  ExpectBaseline(PictureOf(map, -40), "DisparityMap");
}

TEST(StagePictures, CutThroughPhi)
{
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(Maps());
  vtkNew<vtkSampleFunction> samples;
  samples->SetImplicitFunction(phi);
  samples->SetModelBounds(-3, 3, -0.5, 0.5, -0.5, 3);
  samples->SetSampleDimensions(61, 11, 36);
  samples->ComputeNormalsOff();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0.013, 0);
  plane->SetNormal(0, 1, 0);
  vtkNew<vtkCutter> cutter;
  cutter->SetInputConnection(samples->GetOutputPort());
  cutter->SetCutFunction(plane);
  cutter->Update();
  vtkNew<vtkPolyData> section;
  section->ShallowCopy(cutter->GetOutput());
  vtkDataArray* values = section->GetPointData()->GetScalars();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    const double value = values->GetTuple1(i), shade = 255 * std::exp(-std::abs(value));
    const double* point = section->GetPoint(i);
    const bool isInside = std::abs(point[0]) < 0.9 && point[2] > 0.1 && point[2] < 1.9;
    const bool isOutside = std::abs(point[0]) < 0.9 && point[2] > 2.15;
    EXPECT_FALSE(isInside && value > 0) << point[0] << " " << point[2];
    EXPECT_FALSE(isOutside && value < 0) << point[0] << " " << point[2];
    colors->InsertNextTuple3(value < 0 ? 255 : shade, shade, value < 0 ? shade : 255);
  }
  section->GetPointData()->SetScalars(colors);
  ExpectBaseline(PictureOf(section, -90, 0), "PhiCut");
}

TEST(StagePictures, PlainContour)
{
  const auto surface = Contour([](vtkBisectionContourFilter*) {});
  EXPECT_NEAR(HeightAt(surface, 0, 0), 2, 0.01);
  ExpectBaseline(PictureOf(surface), "ContourPlain");
}

TEST(StagePictures, SharpContour)
{
  const auto plain = Contour([](vtkBisectionContourFilter*) {});
  const auto surface = Contour([](vtkBisectionContourFilter* contour) { contour->SharpEdgesOn(); });
  EXPECT_NEAR(HeightAt(surface, 0, 0), 2, 0.01);
  EXPECT_GT(CountOnTopEdges(surface), 2 * CountOnTopEdges(plain))
    << "marching cubes cuts edges off";
  ExpectBaseline(PictureOf(surface), "ContourSharp");
}

TEST(StagePictures, ObservedContour)
{
  const auto whole = Contour([](vtkBisectionContourFilter*) {});
  const auto surface =
    Contour([](vtkBisectionContourFilter* contour) { contour->ObservedOnlyOn(); });
  EXPECT_LT(surface->GetNumberOfPolys(), whole->GetNumberOfPolys());
  EXPECT_NEAR(HeightAt(surface, 0, 0), 2, 0.01);
  vtkDataArray* kind = surface->GetCellData()->GetArray("Kind");
  vtkDataArray* supported = surface->GetCellData()->GetArray("Supported");
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    EXPECT_TRUE(kind->GetTuple1(t) == 0 || supported->GetTuple1(t) == 1) << t;
  }
  ExpectBaseline(PictureOf(surface), "ContourObserved");
}

TEST(StagePictures, SimplifiedContour)
{
  const auto whole = Contour([](vtkBisectionContourFilter*) {});
  vtkNew<vtkSimplifySurfaceFilter> simplify;
  simplify->SetInputData(whole);
  simplify->SetDistance(0.02);
  simplify->Update();
  vtkPolyData* surface = simplify->GetOutput();
  EXPECT_LT(surface->GetNumberOfPolys(), whole->GetNumberOfPolys() / 2);
  vtkNew<vtkMassProperties> before, after;
  before->SetInputData(whole);
  after->SetInputData(surface);
  EXPECT_NEAR(after->GetVolume(), before->GetVolume(), 0.02 * before->GetSurfaceArea());
  ExpectBaseline(PictureOf(surface), "ContourSimplified");
}

TEST(StagePictures, BakedTexture)
{
  const BlockScene scene;
  vtkNew<vtkTextureBaker> baker;
  baker->SetInputData(scene.Surface());
  baker->SetPhotographs(scene.Photographs(BlockCameras));
  baker->SetLargestTexture(128);
  baker->Update();
  auto* surface = vtkPolyData::SafeDownCast(baker->GetOutputDataObject(0));
  vtkDataArray* colors = surface->GetPointData()->GetArray("RGB");
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    if (point[2] > 1.9)
    {
      EXPECT_GT(colors->GetComponent(i, 0), 150) << "the block is red";
      EXPECT_LT(colors->GetComponent(i, 1), 60);
    }
  }
  ExpectBaseline(PictureOf(surface), "BakedColors");
  ExpectBaseline(baker->GetTexture(), "BakedTexture");
}

TEST(StagePictures, Overlay)
{
  std::string pattern = (std::filesystem::temp_directory_path() / "freespace-test-XXXXXX").string();
  const std::string folder = mkdtemp(pattern.data());
  const auto photographs = BlockScene().Photographs(BlockCameras);
  vtkNew<vtkPNGWriter> png;
  png->SetInputData(vtkImageData::SafeDownCast(photographs->GetBlock(0)));
  png->SetFileName((folder + "/p0.png").c_str());
  png->Write();
  const auto features = BlockFeatures();
  features->SetNumberOfBlocks(1);
  vtkNew<vtkFeatureOverlayWriter> overlay;
  overlay->SetInputDataObject(features);
  overlay->SetImagesFolder(folder);
  overlay->SetOutputFolder(folder + "/overlay");
  ASSERT_EQ(overlay->Write(), 1);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder + "/overlay/v0.png").c_str());
  reader->Update();
  vtkImageData* drawn = reader->GetOutput();
  EXPECT_EQ(drawn->GetDimensions()[0], 240);
  EXPECT_EQ(drawn->GetDimensions()[1], 200);
  // Each feature is drawn where it is seen, in a colour between blue and red that the darkened image lacks.
  auto* view = vtkPolyData::SafeDownCast(features->GetBlock(0));
  vtkDataArray* pixels = view->GetPointData()->GetArray("ImagePoint");
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    const double* pixel = pixels->GetTuple2(i);
    int brightest = 0;
    for (int j = 0; j < 9; ++j) // the mark may be rounded to the next pixel
    {
      const auto* rgb = static_cast<unsigned char*>(drawn->GetScalarPointer(
        static_cast<int>(pixel[0]) + j % 3 - 1, 199 - static_cast<int>(pixel[1]) + j / 3 - 1, 0));
      brightest = std::max<int>({ brightest, rgb[0], rgb[1], rgb[2] });
    }
    EXPECT_GT(brightest, 120) << "feature " << i;
  }
  ExpectBaseline(drawn, "FeatureOverlay");
  std::filesystem::remove_all(folder);
}

TEST(StagePictures, OccupancyMap)
{
  const freespace::TemporaryFolder folder;
  vtkNew<vtkOccupancyMapWriter> writer;
  SetPlain(writer.Get());
  writer->SetInputDataObject(Maps());
  writer->SetFileName(folder.Path("map.bt"));
  writer->SetResolution(0.25);
  ASSERT_EQ(writer->Write(), 1);
  const octomap::OcTree tree(folder.Path("map.bt"));
  // Of the block every cell that a view looks at is occupied, and above it none.
  vtkNew<vtkAppendPolyData> cubes;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
  {
    const octomap::point3d middle = leaf.getCoordinate();
    const double half = leaf.getSize() / 2;
    const double side = std::max(std::abs(middle.x()), std::abs(middle.y())) + half;
    const bool isOccupied = tree.isNodeOccupied(*leaf);
    EXPECT_FALSE(middle.z() - half > 2.01 && isOccupied) << "over the block at " << middle;
    EXPECT_FALSE(side < 0.99 && middle.z() - half > 0 && middle.z() + half < 1.99 && !isOccupied)
      << "in the block at " << middle;
    if (isOccupied)
    {
      vtkNew<vtkCubeSource> cube;
      cube->SetCenter(middle.x(), middle.y(), middle.z());
      cube->SetXLength(2 * half);
      cube->SetYLength(2 * half);
      cube->SetZLength(2 * half);
      cube->Update();
      cubes->AddInputData(cube->GetOutput());
    }
  }
  cubes->Update();
  ExpectBaseline(PictureOf(cubes->GetOutput()), "OccupancyMap");
}
