// SPDX-License-Identifier: BSD-3-Clause
// The comparison of pictures must see what VTK's usual metric does not.
#include "Support/PictureComparison.h"

#include "vtkSurfacePicture.h"

#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

namespace
{

vtkSmartPointer<vtkImageData> SpherePicture(double radius, int facets)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(facets);
  sphere->SetPhiResolution(facets);
  const double intrinsics[9] = { 200, 0, 80, 0, 200, 60, 0, 0, 1 };
  const double pose[12] = { 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 3 };
  const int size[2] = { 160, 120 };
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputConnection(sphere->GetOutputPort());
  picture->SetView(intrinsics, pose, size);
  picture->Update();
  return picture->GetOutput();
}

}

TEST(PictureComparison, SameSceneIsAlike)
{
  const PictureDifference same = ComparePictures(SpherePicture(0.5, 16), SpherePicture(0.5, 16));
  EXPECT_EQ(same.mean, 0.0);
  EXPECT_EQ(same.share, 0.0);
  EXPECT_TRUE(AreAlike(same));
}

TEST(PictureComparison, SmallerSphereIsNot)
{
  EXPECT_FALSE(AreAlike(ComparePictures(SpherePicture(0.5, 16), SpherePicture(0.49, 16))));
}

TEST(PictureComparison, SphereOfFewerFacetsIsNot)
{
  EXPECT_FALSE(AreAlike(ComparePictures(SpherePicture(0.5, 16), SpherePicture(0.5, 15))));
}

TEST(PictureComparison, OtherSizeIsNot)
{
  vtkNew<vtkImageData> other;
  other->SetDimensions(160, 119, 1);
  other->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  EXPECT_FALSE(AreAlike(ComparePictures(SpherePicture(0.5, 16), other)));
}
