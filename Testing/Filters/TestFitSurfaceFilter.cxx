// SPDX-License-Identifier: BSD-3-Clause
// A sphere with noise, fitted to features of the true one.
#include "vtkFitSurfaceFilter.h"

#include "Data/PointNormals.h"
#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"
#include "Support/FeatureViews.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

// The unit sphere, its points moved along their radii by noise of a hundredth.
vtkSmartPointer<vtkPolyData> NoisySphere(int precision = vtkAlgorithm::DOUBLE_PRECISION)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1);
  source->SetThetaResolution(40);
  source->SetPhiResolution(40);
  source->SetOutputPointsPrecision(precision);
  source->Update();
  vtkSmartPointer<vtkPolyData> sphere = source->GetOutput();
  std::mt19937 random(3);
  std::normal_distribution<double> noise(1, 0.01);
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    const Eigen::Vector3d moved = noise(random) * Eigen::Vector3d(sphere->GetPoint(i));
    sphere->GetPoints()->SetPoint(i, moved.data());
  }
  sphere->GetPointData()->Initialize();
  vtkNew<vtkIntArray> label;
  label->SetName("View");
  label->SetNumberOfTuples(sphere->GetNumberOfCells());
  label->Fill(7);
  sphere->GetCellData()->AddArray(label);
  return sphere;
}

// Of six cameras at 6 from the middle the features that face them.
vtkSmartPointer<vtkMultiBlockDataSet> Features()
{
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int v = 0; v < 6; ++v)
  {
    View view = MakeView();
    view.name = "view" + std::to_string(v);
    const Eigen::Vector3d z = (v % 2 ? 1 : -1) * Eigen::Vector3d::Unit(v / 2),
                          x = z.unitOrthogonal();
    view.camera.R << x.transpose(), z.cross(x).transpose(), z.transpose();
    view.camera.t = { 0, 0, 6 };
    while (view.points.size() < 1000)
    {
      const Eigen::Vector3d p =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      if (p.dot(-z) > 0.5)
      {
        AddFeature(view, p);
      }
    }
    SetNamedBlock(blocks, v, view.name, BlockFromView(view));
  }
  return blocks;
}

double RootMeanSquare(vtkPolyData* sphere)
{
  double sum = 0;
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    sum += std::pow(Eigen::Vector3d(sphere->GetPoint(i)).norm() - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(sphere->GetNumberOfPoints()));
}

}

TEST(FitSurfaceFilter, BringsASphereBackToItsFeatures)
{
  for (const int precision : { vtkAlgorithm::DOUBLE_PRECISION, vtkAlgorithm::SINGLE_PRECISION })
  {
    const auto sphere = NoisySphere(precision);
    vtkNew<vtkFitSurfaceFilter> fit;
    fit->SetInputData(0, sphere);
    fit->SetInputDataObject(1, Features());
    ASSERT_EQ(ErrorOfUpdate(fit), "");
    vtkPolyData* fitted = fit->GetOutput();
    EXPECT_NEAR(RootMeanSquare(sphere), 0.01, 0.001);
    EXPECT_LT(RootMeanSquare(fitted), 0.004);
    EXPECT_EQ(fitted->GetPoints()->GetDataType(), sphere->GetPoints()->GetDataType());
    ASSERT_EQ(fitted->GetNumberOfPolys(), sphere->GetNumberOfPolys());
    EXPECT_EQ(fitted->GetCellData()->GetArray("View")->GetRange()[0], 7) << "cell arrays pass";
    EXPECT_NEAR(RootMeanSquare(sphere), 0.01, 0.001) << "the input is as it was";
  }
}

TEST(FitSurfaceFilter, NormalsAreThoseOfTheFittedSurface)
{
  const auto sphere = NoisySphere();
  ComputePointNormals(sphere);
  vtkNew<vtkFitSurfaceFilter> fit;
  fit->SetInputData(0, sphere);
  fit->SetInputDataObject(1, Features());
  fit->Update();
  const auto error = [](vtkPolyData* surface)
  {
    double sum = 0;
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const Eigen::Vector3d normal(surface->GetPointData()->GetNormals()->GetTuple3(i));
      sum += (normal - Eigen::Vector3d(surface->GetPoint(i)).normalized()).norm();
    }
    return sum / static_cast<double>(surface->GetNumberOfPoints());
  };
  EXPECT_LT(error(fit->GetOutput()), 0.6 * error(sphere));
}

TEST(FitSurfaceFilter, NoRoundsLeaveTheSurface)
{
  const auto sphere = NoisySphere();
  vtkNew<vtkFitSurfaceFilter> fit;
  fit->SetInputData(0, sphere);
  fit->SetInputDataObject(1, Features());
  fit->SetRounds(0);
  fit->Update();
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(Eigen::Vector3d(fit->GetOutput()->GetPoint(i)), Eigen::Vector3d(sphere->GetPoint(i)));
  }
}

TEST(FitSurfaceFilter, BadInputIsAnErrorAndLeavesNothing)
{
  vtkNew<vtkFitSurfaceFilter> fit;
  fit->SetInputData(0, NoisySphere());
  fit->SetInputDataObject(1, Features());
  fit->SetWaviness(0);
  EXPECT_NE(ErrorOfUpdate(fit), "");
  EXPECT_EQ(fit->GetOutput()->GetNumberOfPoints(), 0);
  fit->SetWaviness(0.05);
  vtkNew<vtkPolyData> quad;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i / 2, i % 2, 0);
  }
  cells->InsertNextCell({ 0, 1, 3, 2 });
  quad->SetPoints(points);
  quad->SetPolys(cells);
  fit->SetInputData(0, quad);
  EXPECT_NE(ErrorOfUpdate(fit).find("triangle"), std::string::npos);
  EXPECT_EQ(fit->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkMultiBlockDataSet> noViews;
  noViews->SetBlock(0, vtkNew<vtkPolyData>());
  fit->SetInputData(0, NoisySphere());
  fit->SetInputDataObject(1, noViews);
  EXPECT_NE(ErrorOfUpdate(fit).find("CameraIntrinsics"), std::string::npos);
  EXPECT_EQ(fit->GetOutput()->GetNumberOfPoints(), 0);
}
