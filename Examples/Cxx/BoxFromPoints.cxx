// SPDX-License-Identifier: BSD-3-Clause
// A view of one's own features, and Phi in VTK's own filters: two cameras look at the front of a box,
// and a plane cuts the free space that they see. Writes the section: BoxFromPoints [OUT.vtp]
#include <vtkCutter.h>
#include <vtkDelaunayDisparityFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFreespaceUnion.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSampleFunction.h>
#include <vtkSurfaceWriter.h>

#include <initializer_list>
#include <iostream>

namespace
{

constexpr double focalLength = 600;
constexpr int width = 640;
constexpr int height = 480;

void AddFieldArray(vtkPolyData* view, const char* name, std::initializer_list<double> values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.begin());
  view->GetFieldData()->AddArray(array);
}

// A camera at (cameraX, 0, 0) that looks along z, with the arrays that say so.
vtkSmartPointer<vtkPolyData> MakeView(double cameraX)
{
  auto view = vtkSmartPointer<vtkPolyData>::New();
  AddFieldArray(view, "CameraIntrinsics",
    { focalLength, 0, width / 2.0, 0, focalLength, height / 2.0, 0, 0, 1 });
  AddFieldArray(view, "CameraFromWorld", { 1, 0, 0, -cameraX, 0, 1, 0, 0, 0, 0, 1, 0 });
  vtkNew<vtkIntArray> size;
  size->SetName("ImageSize");
  size->SetNumberOfComponents(2);
  const int values[2] = { width, height };
  size->InsertNextTypedTuple(values);
  view->GetFieldData()->AddArray(size);
  return view;
}

// The outline of a box's front (1 wide, 3 away) before the border of a wall (6 away).
vtkSmartPointer<vtkPoints> MakeFeatures()
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const double depth : { 3.0, 6.0 })
  {
    const double half = depth == 3.0 ? 0.5 : 2.0;
    for (int i = 0; i < 40; ++i)
    {
      const double s = half * (i / 20.0 - 1);
      points->InsertNextPoint(s, -half, depth);
      points->InsertNextPoint(half, s, depth);
      points->InsertNextPoint(-s, half, depth);
      points->InsertNextPoint(-half, -s, depth);
    }
  }
  return points;
}

void AddFeatures(vtkPolyData* view, vtkPoints* points, double cameraX)
{
  vtkNew<vtkDoubleArray> pixels;
  pixels->SetName("ImagePoint");
  pixels->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    pixels->InsertNextTuple2(width / 2.0 + focalLength * (x[0] - cameraX) / x[2],
      height / 2.0 + focalLength * x[1] / x[2]);
  }
  view->SetPoints(points);
  view->GetPointData()->AddArray(pixels);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkMultiBlockDataSet> features;
  for (int i = 0; i < 2; ++i)
  {
    const double cameraX = i - 0.5;
    auto view = MakeView(cameraX);
    AddFeatures(view, MakeFeatures(), cameraX);
    features->SetBlock(i, view);
  }
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputDataObject(features);
  maps->Update();
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps->GetOutput());

  vtkNew<vtkSampleFunction> lattice;
  lattice->SetImplicitFunction(phi);
  lattice->SetModelBounds(-2, 2, -2, 2, 1, 6.5);
  lattice->SetSampleDimensions(65, 65, 65);
  lattice->ComputeNormalsOff();
  vtkNew<vtkPlane> plane; // y = 0.01
  plane->SetOrigin(0, 0.01, 0);
  plane->SetNormal(0, 1, 0);
  vtkNew<vtkCutter> section;
  section->SetInputConnection(lattice->GetOutputPort());
  section->SetCutFunction(plane);
  section->Update();
  std::cout << "A section of " << section->GetOutput()->GetNumberOfPoints() << " points.\n";

  const bool right = phi->EvaluateFunction(0, 0, 2.8) > 0 // before the box
    && phi->EvaluateFunction(0, 0, 3.3) < 0               // behind its front
    && phi->EvaluateFunction(1.2, 0, 4) > 0;              // beside it
  std::cout << (right ? "Phi is free before the box and matter behind its front.\n"
                      : "Phi is not what it should be.\n");
  if (argc > 1)
  {
    vtkNew<vtkSurfaceWriter> writer;
    writer->SetInputConnection(section->GetOutputPort());
    writer->SetFileName(argv[1]);
    return writer->Write() && right ? 0 : 1;
  }
  return right ? 0 : 1;
}
