// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceComparison.h"

#include "Support/ErrorObserver.h"

#include <vtkDataArray.h>
#include <vtkDistancePolyDataFilter.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

vtkSmartPointer<vtkPolyData> Sphere(double radius, int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  return sphere->GetOutput();
}

}

TEST(vtkSurfaceComparison, HasTheDistancesOfVTK)
{
  const auto surface = Sphere(1, 40), reference = Sphere(1.1, 9);
  vtkNew<vtkSurfaceComparison> comparison;
  comparison->SetInputDataObject(0, surface);
  comparison->SetInputDataObject(1, reference);
  comparison->SetSamples(1000);
  comparison->Update();
  vtkNew<vtkDistancePolyDataFilter> vtk;
  vtk->SetInputData(0, surface);
  vtk->SetInputData(1, reference);
  vtk->SignedDistanceOff();
  vtk->Update();
  for (int port = 0; port < 2; ++port)
  {
    vtkDataArray* distances = comparison->GetOutput(port)->GetPointData()->GetArray("Distance");
    vtkPolyData* expected = port == 0 ? vtk->GetOutput() : vtk->GetSecondDistanceOutput();
    ASSERT_TRUE(distances);
    ASSERT_EQ(distances->GetNumberOfTuples(), expected->GetNumberOfPoints());
    for (vtkIdType i = 0; i < distances->GetNumberOfTuples(); ++i)
    {
      EXPECT_NEAR(distances->GetTuple1(i),
        std::abs(expected->GetPointData()->GetArray("Distance")->GetTuple1(i)), 1e-12);
    }
  }
}

TEST(vtkSurfaceComparison, TellsItsFigures)
{
  vtkNew<vtkSurfaceComparison> comparison;
  comparison->SetInputDataObject(0, Sphere(1, 80));
  comparison->SetInputDataObject(1, Sphere(1.1, 80));
  comparison->SetLimits({ 0.05, 0.2 });
  comparison->SetSamples(5000);
  comparison->SetBins(4);
  EXPECT_TRUE(comparison->GetF().empty());
  comparison->Update();
  EXPECT_EQ(comparison->GetUsedLimits(), (std::vector<double>{ 0.05, 0.2 }));
  EXPECT_EQ(comparison->GetAccuracy(), (std::vector<double>{ 0, 1 }));
  EXPECT_EQ(comparison->GetCompleteness(), (std::vector<double>{ 0, 1 }));
  EXPECT_EQ(comparison->GetF(), (std::vector<double>{ 0, 1 }));
  const auto histogram = comparison->GetHistogram(vtkSurfaceComparison::SurfaceToReference);
  ASSERT_EQ(histogram.size(), 5u);
  EXPECT_NEAR(histogram[1] + histogram[2], 1, 1e-12) << "from 0.05 to 0.15";
  for (int from = 0; from < 2; ++from)
  {
    EXPECT_NEAR(comparison->GetMeanDistance(from), 0.1, 0.002);
    EXPECT_NEAR(comparison->GetMedianDistance(from), 0.1, 0.002);
    EXPECT_NEAR(comparison->GetRootMeanSquareDistance(from), 0.1, 0.002);
    EXPECT_NEAR(comparison->GetGreatestDistance(from), 0.1, 0.003);
    EXPECT_LT(comparison->GetMeanAngle(from), 3);
  }
}

TEST(vtkSurfaceComparison, FailsWithoutASurface)
{
  vtkNew<vtkSurfaceComparison> comparison;
  vtkNew<vtkPolyData> empty;
  comparison->SetInputDataObject(0, Sphere(1, 8));
  comparison->SetInputDataObject(1, empty);
  vtkNew<ErrorObserver> errors;
  errors->Observe(comparison);
  comparison->Update();
  EXPECT_TRUE(errors->Has("The reference has no triangle with an area."));
  EXPECT_EQ(comparison->GetOutput(0)->GetNumberOfPoints(), 0);
  EXPECT_EQ(comparison->GetOutput(1)->GetNumberOfPoints(), 0);
}
