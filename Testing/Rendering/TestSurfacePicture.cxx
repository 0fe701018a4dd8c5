// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePicture.h"

#include "Common/Camera.h"
#include "Support/ErrorObserver.h"
#include "Support/PictureComparison.h"
#include "vtkSurfaceComparison.h"
#include "Support/TemporaryFolder.h"

#include <vtkAppendPolyData.h>
#include <vtkCubeSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPlaneSource.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>

#include <array>

namespace fs = std::filesystem;

namespace
{

// A ball on a slab; the slab's top is z = 0.
vtkSmartPointer<vtkPolyData> BallOnSlab()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.5);
  ball->SetCenter(0.0, 0.0, 0.5);
  ball->SetThetaResolution(32);
  ball->SetPhiResolution(16);
  vtkNew<vtkCubeSource> slab;
  slab->SetBounds(-1.5, 1.5, -1.0, 1.0, -0.2, 0.0);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(ball->GetOutputPort());
  both->AddInputConnection(slab->GetOutputPort());
  both->Update();
  vtkSmartPointer<vtkPolyData> surface = both->GetOutput();
  surface->GetPointData()->Initialize();
  return surface;
}

// From straight above at height 4: 100 pixels to the unit on the slab, x right, y up in the
// picture.
const double FromAboveK[9] = { 400, 0, 170, 0, 400, 110, 0, 0, 1 };
const double FromAbove[12] = { 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 4 };
const int FromAboveSize[2] = { 320, 240 };

std::array<int, 3> Colour(vtkImageData* picture, int column, int row) // row 0 at the top
{
  int size[3];
  picture->GetDimensions(size);
  const auto* pixel =
    static_cast<const unsigned char*>(picture->GetScalarPointer(column, size[1] - 1 - row, 0));
  return { pixel[0], pixel[1], pixel[2] };
}

bool IsWhite(vtkImageData* picture, int column, int row)
{
  return Colour(picture, column, row) == std::array<int, 3>{ 255, 255, 255 };
}

}

TEST(SurfacePicture, CalibratedViewIsExact)
{
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->Update();
  vtkImageData* image = picture->GetOutput();
  EXPECT_EQ(image->GetDimensions()[0], 320);
  EXPECT_EQ(image->GetDimensions()[1], 240);
  // The slab's edges are at u = 170 -+ 150 and v = 110 -+ 100.
  EXPECT_TRUE(IsWhite(image, 18, 110));
  EXPECT_FALSE(IsWhite(image, 20, 110));
  EXPECT_FALSE(IsWhite(image, 319, 110));
  EXPECT_TRUE(IsWhite(image, 100, 8));
  EXPECT_FALSE(IsWhite(image, 100, 10));
  EXPECT_FALSE(IsWhite(image, 100, 209));
  EXPECT_TRUE(IsWhite(image, 100, 211));
  ExpectBaseline(image, "SurfacePictureFromAbove");
}

TEST(SurfacePicture, DefaultViewShowsAllAndFillsThePicture)
{
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  for (const auto& size : { std::array<int, 2>{ 320, 240 }, { 200, 300 } })
  {
    picture->SetSize(size.data());
    picture->Update();
    vtkImageData* image = picture->GetOutput();
    int box[4] = { size[0], 0, size[1], 0 };
    for (int row = 0; row < size[1]; ++row)
    {
      for (int column = 0; column < size[0]; ++column)
      {
        if (!IsWhite(image, column, row))
        {
          box[0] = std::min(box[0], column);
          box[1] = std::max(box[1], column);
          box[2] = std::min(box[2], row);
          box[3] = std::max(box[3], row);
        }
      }
    }
    EXPECT_GT(box[0], 0);
    EXPECT_LT(box[1], size[0] - 1);
    EXPECT_GT(box[2], 0);
    EXPECT_LT(box[3], size[1] - 1);
    EXPECT_GT(std::max(double(box[1] - box[0]) / size[0], double(box[3] - box[2]) / size[1]), 0.9);
  }
  picture->SetSize(320, 240);
  picture->Update();
  ExpectBaseline(picture->GetOutput(), "SurfacePictureDefault");
}

TEST(SurfacePicture, LooksFromWhereItIsTold)
{
  // A slab: wide along x, narrow along y, flat along z.
  vtkNew<vtkCubeSource> slab;
  slab->SetXLength(4);
  slab->SetYLength(2);
  slab->SetZLength(0.5);
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputConnection(slab->GetOutputPort());
  picture->SetSize(200, 200);
  const auto ratio = [&](double azimuth, double elevation)
  {
    picture->SetAzimuth(azimuth);
    picture->SetElevation(elevation);
    picture->Update();
    int box[4] = { 200, 0, 200, 0 };
    for (int row = 0; row < 200; ++row)
    {
      for (int column = 0; column < 200; ++column)
      {
        if (!IsWhite(picture->GetOutput(), column, row))
        {
          box[0] = std::min(box[0], column);
          box[1] = std::max(box[1], column);
          box[2] = std::min(box[2], row);
          box[3] = std::max(box[3], row);
        }
      }
    }
    return double(box[1] - box[0]) / (box[3] - box[2]);
  };
  // The near face alone is seen, and perspective leaves its sides in proportion.
  EXPECT_NEAR(ratio(0, 0), 2 / 0.5, 0.2) << "from +x: y across, z up";
  EXPECT_NEAR(ratio(-90, 0), 4 / 0.5, 0.5) << "from -y: x across, z up";
  EXPECT_NEAR(ratio(-90, 90), 4 / 2.0, 0.1) << "from above: x across, y up";
  EXPECT_NEAR(ratio(0, 90), 2 / 4.0, 0.05) << "from above: y across";
  EXPECT_NEAR(ratio(180, -90), 2 / 4.0, 0.05) << "from below";
  picture->SetElevation(95);
  EXPECT_EQ(picture->GetElevation(), 90);
}

TEST(SurfacePicture, GoesBackToTheDefaultView)
{
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  picture->SetSize(160, 120);
  picture->Update();
  vtkNew<vtkImageData> first;
  first->DeepCopy(picture->GetOutput());
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->Update();
  EXPECT_EQ(picture->GetOutput()->GetDimensions()[0], 320);
  picture->NoView();
  picture->Update();
  EXPECT_EQ(ComparePictures(first, picture->GetOutput()).mean, 0.0);
}

TEST(SurfacePicture, ShowsColoursOfPoints)
{
  auto surface = BallOnSlab();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  const unsigned char green[3] = { 0, 255, 0 };
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    colours->InsertNextTypedTuple(green);
  }
  surface->GetPointData()->SetScalars(colours);
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(surface);
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->Update();
  const auto colour = Colour(picture->GetOutput(), 60, 60);
  EXPECT_EQ(colour[0], 0);
  EXPECT_GT(colour[1], 100);
  EXPECT_EQ(colour[2], 0);
}

TEST(SurfacePicture, DrawsTheEdgesOfTriangles)
{
  vtkNew<vtkPlaneSource> grid; // 4 x 4 squares of half a unit: 50 pixels
  grid->SetOrigin(-1, -1, 0);
  grid->SetPoint1(1, -1, 0);
  grid->SetPoint2(-1, 1, 0);
  grid->SetResolution(4, 4);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(grid->GetOutputPort());
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputConnection(triangles->GetOutputPort());
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->EdgesOn();
  picture->Update();
  vtkImageData* image = picture->GetOutput();
  const auto isDark = [&](int column, int row)
  {
    int darkest = 255;
    for (int i = 0; i < 9; ++i)
    {
      darkest = std::min(darkest, Colour(image, column + i % 3 - 1, row + i / 3 - 1)[0]);
    }
    return darkest < 150; // the surface is about 200
  };
  for (int i = 0; i < 16; ++i)
  {
    const int left = 70 + 50 * (i % 4), top = 10 + 50 * (i / 4);
    EXPECT_TRUE(isDark(left, top + 10)) << "left of square " << i;
    EXPECT_TRUE(isDark(left + 10, top)) << "top of square " << i;
    EXPECT_NE(isDark(left + 12, top + 12), isDark(left + 38, top + 12))
      << "one diagonal of square " << i;
    EXPECT_FALSE(isDark(left + 25, top + 12)) << "no edge in square " << i;
  }
  ExpectBaseline(image, "SurfacePictureEdges");
}

// The distances to a plane of a surface that is inclined to it, with the bar that tells them.
TEST(SurfacePicture, ColoursByDistancesToAReference)
{
  vtkNew<vtkPlaneSource> inclined, reference;
  inclined->SetOrigin(-1, -1, -0.3);
  inclined->SetPoint1(1, -1, 0.3);
  inclined->SetPoint2(-1, 1, -0.3);
  inclined->SetResolution(20, 20);
  reference->SetOrigin(-9, -9, 0);
  reference->SetPoint1(9, -9, 0);
  reference->SetPoint2(-9, 9, 0);
  vtkNew<vtkSurfaceComparison> comparison;
  comparison->SetInputConnection(0, inclined->GetOutputPort());
  comparison->SetInputConnection(1, reference->GetOutputPort());
  comparison->SetSamples(0);
  comparison->Update();
  auto* surface = vtkPolyData::SafeDownCast(comparison->GetOutputDataObject(0));
  vtkDataArray* distances = surface->GetPointData()->GetArray("Distance");
  ASSERT_EQ(distances->GetNumberOfTuples(), 21 * 21);
  for (vtkIdType i = 0; i < distances->GetNumberOfTuples(); ++i)
  {
    EXPECT_NEAR(distances->GetTuple1(i), std::abs(surface->GetPoint(i)[2]), 1e-7);
  }
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(surface);
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->SetColorArray("Distance");
  picture->Update();
  vtkImageData* image = picture->GetOutput();
  const auto middle = Colour(image, 170, 110), left = Colour(image, 80, 110);
  EXPECT_GT(middle[2], 2 * middle[0]) << "blue where the distance is 0";
  EXPECT_GT(left[0], 2 * left[2]) << "red where it is greatest";
  const auto top = Colour(image, 272, 40), bottom = Colour(image, 272, 205);
  EXPECT_GT(top[0], 2 * top[2]) << "the bar's upper end";
  EXPECT_GT(bottom[2], 2 * bottom[0]) << "and its lower one";
  const int withoutBar[6] = { 0, 255, 0, 239, 0,
    0 }; // whose words depend on the version of FreeType
  image->Crop(withoutBar);
  ExpectBaseline(image, "SurfacePictureDistances");
}

TEST(SurfacePicture, SurfaceMayChange)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputConnection(sphere->GetOutputPort());
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  picture->Update();
  EXPECT_TRUE(IsWhite(picture->GetOutput(), 170 + 75, 110));
  sphere->SetRadius(1.0);
  picture->Update();
  EXPECT_FALSE(IsWhite(picture->GetOutput(), 170 + 75, 110));
}

TEST(SurfacePicture, WritesThePNGThatItShows)
{
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  const std::string file = folder + "/picture.png";
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  picture->SetView(FromAboveK, FromAbove, FromAboveSize);
  ASSERT_EQ(picture->WritePNG(file), 1);
  ASSERT_EQ(picture->WritePNG(file), 1); // the second replaces the first
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(ComparePictures(reader->GetOutput(), picture->GetOutput()).mean, 0.0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1)
    << "something half-written was left behind";
}

TEST(SurfacePicture, UnwritableFolderIsAnError)
{
  freespace::ExpectedErrors errors;
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  picture->SetSize(32, 24);
  EXPECT_EQ(picture->WritePNG("/nowhere/at/all/picture.png"), 0);
  EXPECT_TRUE(errors.Has("/nowhere/at/all"));
}

TEST(SurfacePicture, EmptySurfaceIsAnError)
{
  freespace::ExpectedErrors errors;
  const freespace::TemporaryFolder temporary;
  const std::string folder = temporary.Path();
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(empty);
  EXPECT_EQ(picture->WritePNG(folder + "/picture.png"), 0);
  EXPECT_TRUE(errors.Has("There is no surface to make a picture of."));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(SurfacePicture, RefusesACameraThatIsNone)
{
  freespace::ExpectedErrors errors;
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputData(BallOnSlab());
  picture->SetSize(32, 24);
  const double noRotation[12] = {};
  picture->SetView(FromAboveK, noRotation, FromAboveSize);
  EXPECT_TRUE(errors.Has("a matrix that is no rotation"));
  picture->Update();
  EXPECT_EQ(picture->GetOutput()->GetDimensions()[0], 32);
}
