// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/ThreadSafeFunction.h"
#include "Support/PlainSettings.h"
#include "vtkBisectionContourFilter.h"
#include "Support/Filters/WatchedSphere.h"

#include <vtkBox.h>
#include <vtkImplicitBoolean.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphere.h>
#include <vtkTransform.h>

#include <gtest/gtest.h>

#include <set>
#include <thread>

using freespace::IsThreadSafeFunction;

namespace
{

vtkSmartPointer<vtkPolyData> Contour(vtkImplicitFunction* function)
{
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(function);
  contour->SetBounds(-1, 1, -1, 1, -1, 1);
  contour->SetCells(40);
  contour->Update();
  return contour->GetOutput();
}

}

TEST(ThreadSafeFunction, IsOneOfVTKsOwn)
{
  vtkNew<vtkSphere> sphere;
  vtkNew<vtkBox> box;
  vtkNew<WatchedSphere> watched;
  EXPECT_TRUE(IsThreadSafeFunction(sphere));
  EXPECT_TRUE(IsThreadSafeFunction(box));
  EXPECT_FALSE(IsThreadSafeFunction(watched));
}

TEST(ThreadSafeFunction, HasNoTransform)
{
  vtkNew<vtkPlane> plane;
  vtkNew<vtkTransform> transform;
  plane->SetTransform(transform);
  EXPECT_FALSE(IsThreadSafeFunction(plane));
}

TEST(ThreadSafeFunction, CombinesThreadSafeOnes)
{
  vtkNew<vtkImplicitBoolean> inner, outer;
  vtkNew<vtkSphere> sphere;
  vtkNew<WatchedSphere> watched;
  inner->AddFunction(sphere);
  outer->AddFunction(inner);
  EXPECT_TRUE(IsThreadSafeFunction(outer));
  inner->AddFunction(watched);
  EXPECT_FALSE(IsThreadSafeFunction(outer));
}

TEST(ThreadSafeFunction, OthersAreEvaluatedOnOneThreadWithTheSameResult)
{
  vtkNew<vtkSphere> sphere;
  vtkNew<WatchedSphere> watched;
  std::set<std::thread::id> threads;
  watched->OnEvaluation = [&threads] { threads.insert(std::this_thread::get_id()); };
  const auto onAllThreads = Contour(sphere);
  const auto onOne = Contour(watched);
  EXPECT_EQ(threads, std::set{ std::this_thread::get_id() });
  ASSERT_GT(onOne->GetNumberOfPoints(), 1000);
  ASSERT_EQ(onAllThreads->GetNumberOfPoints(), onOne->GetNumberOfPoints());
  ASSERT_EQ(onAllThreads->GetNumberOfCells(), onOne->GetNumberOfCells());
  for (vtkIdType i = 0; i < onOne->GetNumberOfPoints(); ++i)
  {
    double a[3], b[3];
    onAllThreads->GetPoint(i, a);
    onOne->GetPoint(i, b);
    ASSERT_TRUE(a[0] == b[0] && a[1] == b[1] && a[2] == b[2]);
  }
}
