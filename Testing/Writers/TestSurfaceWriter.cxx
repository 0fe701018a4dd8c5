// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceWriter.h"

#include "Data/SurfaceViewpoint.h"
#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"
#include "vtkSurfaceReader.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <set>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

using Triangle = std::array<double, 9>;

// The corners in single precision, which all formats keep.
vtkSmartPointer<vtkPolyData> MakeTetrahedron()
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1.5, 0, 0);
  points->InsertNextPoint(0, 2.25, 0);
  points->InsertNextPoint(0, 0, -3.125);
  vtkNew<vtkCellArray> triangles;
  for (const std::array<vtkIdType, 3>& corners :
    { std::array<vtkIdType, 3>{ 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } })
  {
    triangles->InsertNextCell(3, corners.data());
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

std::set<Triangle> Triangles(vtkPolyData* surface)
{
  std::set<Triangle> triangles;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    Triangle triangle;
    for (int corner = 0; corner < 3; ++corner)
    {
      surface->GetPoint(surface->GetCell(i)->GetPointId(corner), &triangle[3 * corner]);
    }
    triangles.insert(triangle);
  }
  return triangles;
}

vtkSmartPointer<vtkPolyData> WriteAndRead(vtkPolyData* surface, const std::string& file)
{
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputDataObject(surface);
  writer->SetFileName(file);
  EXPECT_EQ(writer->Write(), 1);
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(file);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  return reader->GetOutput();
}

}

TEST(vtkSurfaceWriter, WhatIsWrittenIsReadAgain)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  for (const char* name : { "a.ply", "a.stl", "a.obj", "a.vtp", "A.PLY", "A.Stl" })
  {
    SCOPED_TRACE(name);
    const auto read = WriteAndRead(surface, folder.Path(name));
    EXPECT_EQ(read->GetNumberOfPoints(), 4);
    EXPECT_EQ(Triangles(read), Triangles(surface));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator()), 6);
}

// A model in UTM coordinates: single precision has steps of half a metre there.
TEST(vtkSurfaceWriter, CoordinatesFarFromTheOriginAreKept)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    points->InsertNextPoint(
      500000.1 + point[0] / 100, 5400000.3 + point[1] / 100, 300.7 + point[2]);
  }
  surface->SetPoints(points);
  for (const char* name : { "a.ply", "a.obj", "a.vtp" })
  {
    EXPECT_EQ(Triangles(WriteAndRead(surface, folder.Path(name))), Triangles(surface)) << name;
  }
  vtkNew<vtkSurfaceWriter> writer;
  vtkNew<ErrorObserver> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetInputDataObject(surface);
  writer->SetFileName(folder.Path("a.stl"));
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(errors->Has("single precision")) << errors->All;
  EXPECT_FALSE(fs::exists(folder.Path("a.stl")));
}

TEST(vtkSurfaceWriter, PLYAndVTPKeepTheViewpoint)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  camera.K << 70.1, 0, 32.2, 0, 70.3, 24.4, 0, 0, 1;
  camera.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  camera.t = { 0.1, -0.2, 1 / 3.0 };
  AddCamera(surface, camera, "");
  for (const char* name : { "a.ply", "a.vtp" })
  {
    const auto viewpoint = ViewpointOf(WriteAndRead(surface, folder.Path(name)));
    ASSERT_TRUE(viewpoint) << name;
    EXPECT_TRUE(viewpoint->K.isApprox(camera.K, 1e-14)) << name;
    EXPECT_TRUE(viewpoint->R.isApprox(camera.R, 1e-14)) << name;
    EXPECT_TRUE(viewpoint->t.isApprox(camera.t, 1e-14)) << name;
    EXPECT_EQ(viewpoint->width, 64) << name;
    EXPECT_EQ(viewpoint->height, 48) << name;
  }
}

TEST(vtkSurfaceWriter, KnowsItsExtensions)
{
  for (const char* name : { "a.ply", "a.STL", "/x.y/a.obj", "a.b.vtp" })
  {
    EXPECT_TRUE(vtkSurfaceWriter::CanWriteFile(name)) << name;
  }
  for (const char* name : { "", "ply", "a.glb", "a.ply.gz", "a.ply/b" })
  {
    EXPECT_FALSE(vtkSurfaceWriter::CanWriteFile(name)) << name;
  }
}

TEST(vtkSurfaceWriter, FaultsNameTheFileAndLeaveIt)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  vtkNew<vtkPolyData> empty;
  const std::string old = folder.Write("old.ply", "old");
  const std::pair<std::string, vtkPolyData*> cases[] = { { old, empty },
    { folder.Path("a.txt"), surface }, { folder.Path("absent/a.ply"), surface } };
  for (const auto& [file, input] : cases)
  {
    vtkNew<vtkSurfaceWriter> writer;
    vtkNew<ErrorObserver> errors;
    writer->AddObserver(vtkCommand::ErrorEvent, errors);
    writer->SetInputDataObject(input);
    writer->SetFileName(file);
    EXPECT_EQ(writer->Write(), 0) << file;
    EXPECT_TRUE(errors->Has(file)) << errors->All;
  }
  std::string content;
  std::getline(std::ifstream(old), content);
  EXPECT_EQ(content, "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator()), 1);
}
